#pragma once

class vtkRenderWindow;

namespace atrium::render {

/// A VTK window that renders through the X server that DISPLAY names, without showing anything. Null if there is no
/// such server or if it has no OpenGL: VTK itself would end the process then.
vtkRenderWindow* new_x_window();

/// After such a window is gone: leaves no OpenGL context with the thread, which may end after the process has begun to.
void release_x_thread();

}  // namespace atrium::render
