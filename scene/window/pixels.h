#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "scene/panels.h"
#include "scene/scene_state.h"

namespace palpa::scene {

/// Copies rows of bytes in reverse order: our pictures begin at the top, OpenGL's and VTK's at the
/// bottom.
inline void copyFlipped(const std::uint8_t* from, std::uint8_t* to, std::size_t row_bytes,
                        int rows) {
  for (int y = 0; y < rows; ++y)
    std::memcpy(to + (rows - 1 - y) * row_bytes, from + y * row_bytes, row_bytes);
}

}  // namespace palpa::scene

class vtkRenderWindow;

namespace palpa::scene {

/// What the window shows: RGB, top row first. Throws Error when it cannot be read.
Image pixelsOf(vtkRenderWindow& window);

}  // namespace palpa::scene

class vtkRenderWindow;

namespace palpa::scene {

/// A two-dimensional texture of the window's context, rows from the bottom.
struct TextureTarget {
  std::uint32_t texture = 0;
  std::int64_t format = 0;  ///< OpenGL's internal format
  int width = 0, height = 0;
};

/// Copies parts of a window's frames. It goes before its window's context.
class EyeCopier {
 public:
  explicit EyeCopier(vtkRenderWindow& window) : window_(window) {}
  ~EyeCopier();
  EyeCopier(const EyeCopier&) = delete;
  EyeCopier& operator=(const EyeCopier&) = delete;
  /// A part of the last frame, stretched where the sizes differ. Colours are drawn encoded (sRGB):
  /// they stay as they are in a texture that holds such, and are decoded for one that holds linear
  /// colours. Throws Error where the texture cannot be drawn into.
  void copy(const Rect& part, const TextureTarget& target);

 private:
  void readDecoded(const Rect& part);

  vtkRenderWindow& window_;
  /// OpenGL's: framebuffers about the target and about `encoded_`, a texture
  std::uint32_t frame_ = 0, between_ = 0, encoded_ = 0;
  int encoded_width_ = 0, encoded_height_ = 0;
};

}  // namespace palpa::scene
