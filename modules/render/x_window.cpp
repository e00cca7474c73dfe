#include "modules/render/x_window.hpp"

#include <vtkXOpenGLRenderWindow.h>
// After VTK: Xlib's macros are everyday words.
#include <GL/glx.h>
#include <X11/Xlib.h>

namespace atrium::render {
namespace {

bool can_render() {
  ::Display* display = ::XOpenDisplay(nullptr);
  if (display == nullptr) return false;
  int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 8, GLX_DEPTH_SIZE, 24, 0};
  ::XVisualInfo* visual = nullptr;
  if (::glXQueryExtension(display, nullptr, nullptr) != 0)
    visual = ::glXChooseVisual(display, DefaultScreen(display), wanted);
  const bool found = visual != nullptr;
  if (found) ::XFree(visual);
  ::XCloseDisplay(display);
  return found;
}

}  // namespace

vtkRenderWindow* new_x_window() {
  if (!can_render()) return nullptr;
  auto* window = vtkXOpenGLRenderWindow::New();
  window->SetOffScreenRendering(1);
  return window;
}

}  // namespace atrium::render
