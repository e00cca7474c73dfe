#pragma once
#include <memory>

class vtkRenderWindow;

namespace atrium::render {

/// A VTK render window that shows nothing: on EGL's surfaceless platform (Mesa), which needs no X server, no device and
/// no environment variable; where there is none, through the X server that DISPLAY names. Hold a RenderLock while one
/// exists, and use it on the thread that made it only.
class OffscreenWindow {
 public:
  /// Throws Error where there is neither.
  OffscreenWindow(int width, int height);
  ~OffscreenWindow();
  OffscreenWindow(const OffscreenWindow&) = delete;
  OffscreenWindow& operator=(const OffscreenWindow&) = delete;
  vtkRenderWindow* get() const { return window_; }

 private:
  vtkRenderWindow* window_;
  bool surfaceless_ = false;
};

/// One thread at a time uses VTK: OpenGL contexts belong to threads and nodes run on many, and VTK's renderer of text
/// is one for the whole process.
class RenderLock {
 public:
  RenderLock();
  ~RenderLock();
  RenderLock(const RenderLock&) = delete;
  RenderLock& operator=(const RenderLock&) = delete;
};

}  // namespace atrium::render
