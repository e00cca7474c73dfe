#include "modules/render/x_window.hpp"

#include <vtkXOpenGLRenderWindow.h>
// After VTK: Xlib's macros are everyday words.
#include <GL/glx.h>
#include <X11/Xlib.h>

namespace atrium::render {
namespace {

bool can_render(::Display* display) {
  int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 8, GLX_DEPTH_SIZE, 24, 0};
  ::XVisualInfo* visual = nullptr;
  if (::glXQueryExtension(display, nullptr, nullptr) != 0)
    visual = ::glXChooseVisual(display, DefaultScreen(display), wanted);
  const bool found = visual != nullptr;
  if (found) ::XFree(visual);
  return found;
}

/// One connection for the whole process: VTK aborts where its own fails, and a virtual server starts anew when its last
/// client leaves. Null if there is no server that can render.
::Display* connection() {
  static ::Display* const display = [] {
    ::Display* opened = ::XOpenDisplay(nullptr);
    return opened != nullptr && can_render(opened) ? opened : nullptr;
  }();
  return display;
}

}  // namespace

vtkRenderWindow* new_x_window() {
  ::Display* display = connection();
  if (display == nullptr) return nullptr;
  auto* window = vtkXOpenGLRenderWindow::New();
  window->SetDisplayId(display);
  window->SetOffScreenRendering(1);
  return window;
}

void release_x_thread() {
  if (::Display* display = connection(); display != nullptr) ::glXMakeCurrent(display, None, nullptr);
}

}  // namespace atrium::render
