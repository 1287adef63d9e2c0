#pragma once

#include <filesystem>
#include <memory>

#include "ar/camera.h"

namespace palpa::ar {

/// A film as a camera: its pictures in order, stamped with the film's own times from zero. Where
/// "<film>.csv" lies beside it, as this program records it (apps/runtime/video_recorder.h), the
/// times of exposure stand there.
class VideoFile : public Camera {
 public:
  /// Throws Error when the film cannot be opened or holds no picture.
  explicit VideoFile(const std::filesystem::path& file);
  ~VideoFile() override;
  std::optional<Frame> grab() override;
  double rate_Hz() const;  ///< pictures a second: by the times beside it, otherwise as the film
                           ///< says; 30 where neither does

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// By its ending.
bool isVideoFile(const std::filesystem::path& file);

}  // namespace palpa::ar
