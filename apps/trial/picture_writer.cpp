#include "apps/trial/picture_writer.h"

#include <chrono>
#include <utility>

#include "scene/view/scene_view.h"

namespace palpa::trial {

void PictureWriter::begin() {
  pending_ = beside_.start([jobs = std::exchange(waiting_, {})] {
    for (const Job& job : jobs) scene::writePng(job.image, job.file.string());
  });
}

void PictureWriter::write(const std::filesystem::path& file, scene::Image image) {
  waiting_.push_back({file, std::move(image)});
  if (pending_.valid()) {
    if (pending_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    pending_.get();
  }
  begin();
}

void PictureWriter::finish() {
  while (pending_.valid() || !waiting_.empty()) {
    if (pending_.valid()) pending_.get();
    if (!waiting_.empty()) begin();
  }
}

}  // namespace palpa::trial
