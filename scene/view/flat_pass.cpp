#include "scene/view/flat_pass.h"

#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkTextureObject.h>
#include <vtk_glew.h>

#include <string>

namespace palpa::scene {

FlatQuad flatQuad(vtkOpenGLRenderWindow& window, std::initializer_list<const char*> parts) {
  std::string text;
  for (const char* part : parts) text += part;
  return std::make_unique<vtkOpenGLQuadHelper>(&window, nullptr, text.c_str(), nullptr);
}

void keepInside(vtkTextureObject& texture, vtkOpenGLRenderWindow& window, int wrap) {
  texture.SetContext(&window);
  texture.SetWrapS(wrap);
  texture.SetWrapT(wrap);
  texture.SetMinificationFilter(vtkTextureObject::Linear);
  texture.SetMagnificationFilter(vtkTextureObject::Linear);
}

void fit(vtkTextureObject& texture, int width, int height) {
  const auto wide = static_cast<unsigned int>(width), high = static_cast<unsigned int>(height);
  if (texture.GetHandle() == 0)
    texture.Allocate2D(wide, high, 4, VTK_UNSIGNED_CHAR);
  else if (texture.GetWidth() != wide || texture.GetHeight() != high)
    texture.Resize(wide, high);
}

FlatDrawing::FlatDrawing(vtkOpenGLState* state)
    : depth(state, GL_DEPTH_TEST), blend(state, GL_BLEND) {
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDisable(GL_BLEND);
}

void drawInto(vtkTextureObject& texture, vtkOpenGLFramebufferObject& aside,
              vtkOpenGLRenderWindow& window, const std::function<void()>& draw) {
  const auto width = static_cast<int>(texture.GetWidth()),
             height = static_cast<int>(texture.GetHeight());
  vtkOpenGLState& state = *window.GetState();
  const vtkOpenGLState::ScopedglViewport viewport(&state);
  const vtkOpenGLState::ScopedglScissor scissor(&state);
  state.PushFramebufferBindings();
  aside.Bind();
  aside.AddColorAttachment(0, &texture);
  aside.ActivateBuffer(0);
  state.vtkglViewport(0, 0, width, height);
  state.vtkglScissor(0, 0, width, height);
  draw();
  state.PopFramebufferBindings();
}

}  // namespace palpa::scene
