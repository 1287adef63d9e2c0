#include "scene/window/pixels.h"

#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtk_glew.h>

#include "anatomy/base/error.h"

namespace palpa::scene {
namespace {

vtkOpenGLRenderWindow& openGl(vtkRenderWindow& window) {
  return static_cast<vtkOpenGLRenderWindow&>(window);
}

/// VTK remembers what is bound: what we bind it must hear of, and have back.
class Bindings {
 public:
  explicit Bindings(vtkOpenGLState& state) : state_(state) { state_.PushFramebufferBindings(); }
  ~Bindings() { state_.PopFramebufferBindings(); }
  Bindings(const Bindings&) = delete;
  Bindings& operator=(const Bindings&) = delete;

 private:
  vtkOpenGLState& state_;
};

/// The framebuffer, made where there is none, with a texture to draw into.
void drawInto(vtkOpenGLState& state, std::uint32_t* framebuffer, std::uint32_t texture) {
  if (*framebuffer == 0) glGenFramebuffers(1, framebuffer);
  state.vtkglBindFramebuffer(GL_DRAW_FRAMEBUFFER, *framebuffer);
  glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  if (glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Error("the graphics driver does not draw into the headset's pictures", "an eye's picture",
                "Update the graphics driver");
}

void readFrame(vtkOpenGLRenderWindow& window) {
  vtkOpenGLFramebufferObject* const drawn =
      window.GetRenderFramebuffer();  // nothing is multisampled: it holds the frame
  drawn->Bind(GL_READ_FRAMEBUFFER);
  drawn->ActivateReadBuffer(0);
}

void blit(const Rect& from, int width, int height) {
  const bool same = from.width == width && from.height == height;
  glBlitFramebuffer(from.x, from.y, from.right(), from.top(), 0, 0, width, height,
                    GL_COLOR_BUFFER_BIT, same ? GL_NEAREST : GL_LINEAR);
}

}  // namespace

EyeCopier::~EyeCopier() {
  if (frame_ == 0) return;
  window_.MakeCurrent();
  glDeleteFramebuffers(1, &frame_);
  if (between_) glDeleteFramebuffers(1, &between_);
  if (encoded_) glDeleteTextures(1, &encoded_);
}

/// The part through a texture of encoded colours, which a blit then decodes (OpenGL 4.4, 18.3.1):
/// left bound for reading.
void EyeCopier::readDecoded(const Rect& part) {
  vtkOpenGLState& state = *openGl(window_).GetState();
  if (encoded_width_ != part.width || encoded_height_ != part.height) {
    if (encoded_ == 0) glGenTextures(1, &encoded_);
    GLint bound = 0;
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    glBindTexture(GL_TEXTURE_2D, encoded_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, part.width, part.height, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound));
    encoded_width_ = part.width;
    encoded_height_ = part.height;
  }
  drawInto(state, &between_, encoded_);
  readFrame(openGl(window_));
  blit(part, part.width, part.height);
  state.vtkglBindFramebuffer(GL_READ_FRAMEBUFFER, between_);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
}

void EyeCopier::copy(const Rect& part, const TextureTarget& target) {
  vtkOpenGLRenderWindow& window = openGl(window_);
  window.MakeCurrent();
  vtkOpenGLState& state = *window.GetState();
  const Bindings bindings(state);
  state.vtkglDisable(GL_SCISSOR_TEST);
  glDisable(GL_FRAMEBUFFER_SRGB);
  const bool linear = target.format != GL_SRGB8_ALPHA8 && target.format != GL_SRGB8;
  if (linear)
    readDecoded(part);
  else
    readFrame(window);
  drawInto(state, &frame_, target.texture);
  if (linear) glEnable(GL_FRAMEBUFFER_SRGB);
  blit(linear ? Rect{0, 0, part.width, part.height} : part, target.width, target.height);
  glDisable(GL_FRAMEBUFFER_SRGB);
}

Image pixelsOf(vtkRenderWindow& window) {
  const int* size = window.GetSize();
  Image image{size[0], size[1], 3, {}};
  vtkNew<vtkUnsignedCharArray> pixels;
  if (window.GetPixelData(0, 0, image.width - 1, image.height - 1, 0, pixels, 0) == VTK_ERROR)
    throw Error("the frame cannot be read back", "scene", "Update the graphics driver");
  const std::size_t row = static_cast<std::size_t>(image.width) * 3;
  image.pixels.resize(row * image.height);
  copyFlipped(pixels->GetPointer(0), image.pixels.data(), row, image.height);
  return image;
}

}  // namespace palpa::scene
