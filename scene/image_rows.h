#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace palpa::scene {

/// Copies rows of bytes in reverse order: our pictures begin at the top, OpenGL's and VTK's at the
/// bottom.
inline void copyFlipped(const std::uint8_t* from, std::uint8_t* to, std::size_t row_bytes,
                        int rows) {
  for (int y = 0; y < rows; ++y)
    std::memcpy(to + (rows - 1 - y) * row_bytes, from + y * row_bytes, row_bytes);
}

}  // namespace palpa::scene
