#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

#include "scene/scene_state.h"

namespace palpa::replay {

/// The camera's pictures that a session left beside its evidence ("camera.mjpeg": JPEG after JPEG;
/// "camera.mjpeg.csv": when each was taken), any of them at once. Nothing where there are none, or
/// where the table names fewer than one; a picture that cannot be read is passed over.
class RecordedPictures {
 public:
  explicit RecordedPictures(const std::filesystem::path& folder);
  bool empty() const { return times_ns_.empty(); }
  /// The last picture taken at or before this session time; null before the first.
  const scene::Image* at(std::int64_t t_ns);

 private:
  void findPictures();
  void read(std::size_t number);

  std::ifstream film_;
  std::vector<std::int64_t> times_ns_;
  std::vector<std::streamoff> begins_;  ///< of each picture, and the end
  std::size_t shown_ = SIZE_MAX;
  scene::Image image_;
};

}  // namespace palpa::replay
