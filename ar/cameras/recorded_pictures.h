#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "ar/cameras/camera.h"

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

/// A film as a camera: its pictures in order, stamped with the film's own times from zero. Where
/// "<film>.csv" lies beside it, as this program records it (apps/runtime/recorders.h), the
/// times of exposure stand there.
class VideoFile : public Camera {
 public:
  /// Throws Error when the film cannot be opened or holds no picture.
  explicit VideoFile(const std::filesystem::path& file);
  ~VideoFile() override;
  std::optional<Frame> grab() override;
  /// Pictures a second: by the times beside it, otherwise as the film says; 30 where neither does
  double rate_Hz() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// By its ending.
bool isVideoFile(const std::filesystem::path& file);

}  // namespace palpa::ar
