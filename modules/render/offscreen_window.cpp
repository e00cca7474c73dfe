#include "modules/render/offscreen_window.hpp"

// GLEW before any other OpenGL header.
#include <GL/glew.h>
//
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkObjectFactory.h>

#include <array>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

#include "graph/api/error.hpp"
#include "modules/render/x_window.hpp"

namespace atrium::render {
namespace {

/// Why EGL does not do.
class NoEgl : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};
[[noreturn]] void no_rendering(const std::string& reason) { throw NoEgl(reason); }

/// One OpenGL context, for the thread that makes it. It does not outlive the picture: a context that is still there
/// when the process ends, made by a thread that is gone, corrupts memory in Mesa's exit handlers.
struct Context {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLSurface surface = EGL_NO_SURFACE;
  EGLContext context = EGL_NO_CONTEXT;

  Context() {
    try {
      open();
    } catch (...) {
      close();
      throw;
    }
  }
  ~Context() { close(); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  void make_current() const { eglMakeCurrent(display, surface, surface, context); }

 private:
  void open() {
    const auto platform_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (platform_display == nullptr) no_rendering("EGL knows no platforms");
    display = platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE)
      no_rendering("EGL's surfaceless platform does not start");
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) no_rendering("EGL has no OpenGL");
    constexpr std::array<EGLint, 13> wanted{EGL_SURFACE_TYPE,
                                            EGL_PBUFFER_BIT,
                                            EGL_RENDERABLE_TYPE,
                                            EGL_OPENGL_BIT,
                                            EGL_RED_SIZE,
                                            8,
                                            EGL_GREEN_SIZE,
                                            8,
                                            EGL_BLUE_SIZE,
                                            8,
                                            EGL_DEPTH_SIZE,
                                            24,
                                            EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglChooseConfig(display, wanted.data(), &config, 1, &count) == EGL_FALSE || count == 0)
      no_rendering("EGL offers no suitable configuration");
    constexpr std::array<EGLint, 5> size{EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
    surface = eglCreatePbufferSurface(display, config, size.data());
    constexpr std::array<EGLint, 7> version{
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context = eglCreateContext(display, config, EGL_NO_CONTEXT, version.data());
    if (surface == EGL_NO_SURFACE || context == EGL_NO_CONTEXT) no_rendering("no OpenGL 3.2 context can be made");
  }
  void close() const {
    if (display != EGL_NO_DISPLAY) {
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
      if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
      if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
      eglTerminate(display);
    }
    // Also where nothing could be opened: libEGL frees what it keeps for a thread when the process ends, and once more
    // when the thread ends after that.
    eglReleaseThread();
  }
};

std::mutex& render_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

/// VTK's window for a context that somebody else owns, told to use ours.
class SurfacelessWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static SurfacelessWindow* New();
  vtkTypeMacro(SurfacelessWindow, vtkGenericOpenGLRenderWindow);

  void MakeCurrent() override { gl->make_current(); }
  bool IsCurrent() override { return eglGetCurrentContext() == gl->context; }
  void OpenGLInitContext() override {
    if (Initialized != 0) return;
    MakeCurrent();
    GlewInitValid = true;
    Initialized = 1;
    MaximumHardwareLineWidth = 1.0F;
  }

  std::unique_ptr<Context> gl;

 protected:
  SurfacelessWindow() = default;
};
vtkStandardNewMacro(SurfacelessWindow);

namespace {

vtkRenderWindow* new_surfaceless_window() {
  // All that may throw comes before there is a window.
  auto context = std::make_unique<Context>();
  context->make_current();
  glewExperimental = GL_TRUE;
  // Debian's GLEW loads every entry point and only then reports (4) that it finds no GLX display.
  const GLenum result = glewInit();
  if (result != GLEW_OK && result != 4) no_rendering("OpenGL's functions cannot be loaded");
  auto* window = SurfacelessWindow::New();
  window->gl = std::move(context);
  window->SetOffScreenRendering(1);
  window->SetSwapBuffers(0);
  window->SetFrameBlitModeToNoBlit();
  window->SetMapped(1);
  window->SetIsCurrent(true);
  window->SetReadyForRendering(true);
  return window;
}

}  // namespace

OffscreenWindow::OffscreenWindow(int width, int height) : window_(nullptr) {
  std::string reason;
  try {
    window_ = new_surfaceless_window();
  } catch (const NoEgl& problem) {
    reason = problem.what();
  }
  surfaceless_ = window_ != nullptr;
  if (!surfaceless_) window_ = new_x_window();
  if (window_ == nullptr)
    throw Error("no picture can be drawn on this machine: " + reason + ", and there is no X server with OpenGL",
                "install Mesa's software renderer (apt-get install libegl-mesa0 libgl1-mesa-dri), or run it under a "
                "virtual X server: xvfb-run -a atrium …");
  window_->SetMultiSamples(0);
  window_->SetSize(width, height);
  if (!surfaceless_) return;
  window_->MakeCurrent();
  static_cast<SurfacelessWindow*>(window_)->OpenGLInit();
}

OffscreenWindow::~OffscreenWindow() {
  window_->Finalize();
  window_->Delete();
  if (!surfaceless_) release_x_thread();
}

RenderLock::RenderLock() { render_mutex().lock(); }
RenderLock::~RenderLock() { render_mutex().unlock(); }

}  // namespace atrium::render
