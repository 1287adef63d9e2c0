#pragma once

#include <filesystem>
#include <string>

namespace palpa::guide {

struct PictureSize {
  int width = 0, height = 0;  ///< pixels
  bool operator==(const PictureSize&) const = default;
};

/// Empty: there is no such file.
std::string bytesOf(const std::filesystem::path& file);

/// Of a PNG, a JPEG or an SVG that begins with its tag, by its head; throws std::runtime_error for
/// anything else.
PictureSize sizeOf(const std::filesystem::path& picture);

}  // namespace palpa::guide
