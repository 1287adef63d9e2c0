#pragma once

#include <filesystem>

namespace palpa::guide {

struct PictureSize {
  int width = 0, height = 0;  ///< pixels
  bool operator==(const PictureSize&) const = default;
};

/// Of a PNG or JPEG, by its head; throws std::runtime_error for anything else.
PictureSize sizeOf(const std::filesystem::path& picture);

}  // namespace palpa::guide
