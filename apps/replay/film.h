#pragma once

#include <filesystem>

#include "ar/codecs/codecs.h"
#include "scene/scene_state.h"

namespace palpa::replay {

/// A video file, there whole or not at all: written beside under another name, opened again and
/// counted, then renamed. .avi: motion JPEG; .mp4: MPEG-4 part 2. Throws UsageError for another
/// ending, Error for what cannot be written.
class Film {
 public:
  Film(const std::filesystem::path& file, double frames_per_second, int width, int height);
  ~Film();
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  void add(const scene::Image& picture);  ///< of the film's size
  void finish();
  int frames() const { return frames_; }

 private:
  std::filesystem::path file_, beside_;
  std::unique_ptr<cv::VideoWriter> writer_;
  int frames_ = 0, width_, height_;
  bool finished_ = false;
};

/// Fourcc for this ending. Throws UsageError.
int codecOf(const std::filesystem::path& file);

}  // namespace palpa::replay
