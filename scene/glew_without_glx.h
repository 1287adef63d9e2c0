#pragma once

/// VTK starts GLEW, and GLEW asks GLX for a display after it has loaded every OpenGL entry point.
/// On an EGL context that last question fails (GLEW_ERROR_NO_GLX_DISPLAY, 4) and VTK gives up,
/// although OpenGL is ready. This object therefore defines glewInit itself: it calls GLEW's and
/// forgives that one answer while an EGL context is current. The program must export the symbol;
/// palpa_scene's link options see to it.
namespace palpa::scene {

/// True when this process's shared libraries really resolve glewInit to ours. Without that, an EGL
/// window would end in an obscure VTK message: ask first.
bool glewInitIsOurs();

}  // namespace palpa::scene
