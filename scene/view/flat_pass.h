#pragma once

#include <vtkOpenGLQuadHelper.h>
#include <vtkOpenGLState.h>

#include <functional>
#include <initializer_list>
#include <memory>

class vtkOpenGLFramebufferObject;
class vtkOpenGLRenderWindow;
class vtkTextureObject;

/// Steps that work on pixels that are drawn already: a program for each pixel of a picture.
namespace palpa::scene {

using FlatQuad = std::unique_ptr<vtkOpenGLQuadHelper>;
/// Of the pixels' program, in parts; made while the window draws.
FlatQuad flatQuad(vtkOpenGLRenderWindow& window, std::initializer_list<const char*> parts);

/// A picture's part of a window, pixels from its bottom left.
struct FlatPlace {
  int left = 0, bottom = 0, width = 0, height = 0;
};

/// Read between pixels; `wrap`: vtkTextureObject's, beyond the edges.
void keepInside(vtkTextureObject& texture, vtkOpenGLRenderWindow& window, int wrap);
/// To so many pixels, RGBA in bytes.
void fit(vtkTextureObject& texture, int width, int height);

/// For as long as it lives: neither depths nor blending.
struct FlatDrawing {
  explicit FlatDrawing(vtkOpenGLState* state);
  vtkOpenGLState::ScopedglEnableDisable depth, blend;
};

/// What `draw` draws goes into all of the texture, by the frame buffer `aside`.
void drawInto(vtkTextureObject& texture, vtkOpenGLFramebufferObject& aside,
              vtkOpenGLRenderWindow& window, const std::function<void()>& draw);

}  // namespace palpa::scene
