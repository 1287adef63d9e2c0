#include "apps/task_search/floors.h"

#include <chrono>

#include "apps/task_search/gabor_filter.h"
#include "apps/task_search/valley_lines.h"

namespace palpa::task_search {
namespace {

constexpr double kFarthestReach = 5;  // U, where an attraction says none

double reachOf(const SearchSettings& task) {
  double reach = 0;
  for (const double r : task.augmentations.reach_U) reach = std::max(reach, r);
  return reach > 0 ? reach : kFarthestReach;
}

}  // namespace

std::unique_ptr<MadeFloor> makeFloor(const SearchSettings& task, const Episode& episode) {
  auto made = std::make_unique<MadeFloor>(MadeFloor{surfaceOf(task.spec, episode), {}, {}});
  if (episode.mode != assess::SearchMode::augmented) return made;
  const HeightField height = [&surface = made->surface](double x, double y) {
    return surface.smoothHeight(x, y);
  };
  made->rises =
      riseTable(heightMap(height, task.map_px, task.spec.side), task.spec.side, task.rise_share);
  made->valleys.emplace(valleyPoints(height, {task.spec.side}), task.spec.side, reachOf(task));
  return made;
}

void Floors::prepare(std::uint32_t number) {
  Slot& s = slot(number);
  if (number < 1 || number > episodes_.size() || s.coming == number) return;
  s.number.store(0, std::memory_order_release);
  if (s.making.valid()) s.making.wait();
  s.coming = number;
  s.making = std::async(std::launch::async,
                        [this, number] { return makeFloor(task_, episodes_[number - 1]); });
}

bool Floors::ready(std::uint32_t number, bool wait) {
  Slot& s = slot(number);
  if (s.number.load(std::memory_order_acquire) == number) return true;
  if (s.coming != number || !s.making.valid()) return false;
  if (!wait && s.making.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return false;
  s.made = s.making.get();
  s.floor = s.made->floor();
  s.number.store(number, std::memory_order_release);
  return true;
}

const haptics::Floor* Floors::floor(std::uint32_t number) const noexcept {
  const Slot& s = slots_[number % slots_.size()];
  return s.number.load(std::memory_order_acquire) == number ? &s.floor : nullptr;
}

}  // namespace palpa::task_search
