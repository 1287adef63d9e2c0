#pragma once

#include <filesystem>
#include <vector>

#include "ar/camera.h"

namespace palpa::ar {

/// Recorded pictures as a camera: the files that match a shell pattern ("left*.jpg"), ordered by
/// name, byte by byte (so number them with leading zeros), one every 1/fps seconds from zero.
/// JPEG's orientation marks are ignored: intrinsics belong to the sensor.
class ImageSequence : public Camera {
 public:
  /// Throws Error when nothing matches, UsageError when fps is not positive.
  ImageSequence(const std::string& glob, double fps);
  /// Throws Error, naming the file, when a picture is gone, unreadable or of another size.
  std::optional<Frame> grab() override;

  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  std::vector<std::filesystem::path> files_;
  double fps_;
  std::size_t next_ = 0;
  cv::Size size_;
};

}  // namespace palpa::ar
