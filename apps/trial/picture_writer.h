#pragma once

#include <filesystem>
#include <future>
#include <vector>

#include "apps/runtime/own_thread.h"
#include "scene/scene_state.h"

namespace palpa::trial {

/// Pictures into PNG files, in a thread of its own and in their order: to code one takes longer
/// than to draw it. What goes wrong with one is thrown by a later call.
class PictureWriter {
 public:
  void write(const std::filesystem::path& file, scene::Image image);
  /// Returns when all are written.
  void finish();

 private:
  struct Job {
    std::filesystem::path file;
    scene::Image image;
  };
  void begin();

  std::vector<Job> waiting_;
  std::future<void> pending_;
  runtime::OwnThread<void> beside_;
};

}  // namespace palpa::trial
