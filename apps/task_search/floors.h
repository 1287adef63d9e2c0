#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/runtime/haptic_activity.h"
#include "apps/task_search/search_file.h"

namespace palpa::task_search {

/// One episode: how it is rendered and what is searched.
struct Episode {
  std::string block;
  assess::SearchMode mode = assess::SearchMode::real;
  haptics::SearchStimulus stimulus;
  std::uint64_t seed = 1;  ///< of the bumps: one texture for a session
};

/// `count` episodes in one mode; orientation and target by chance, the same for the same seed
/// whatever the mode, so that modes can be compared. Bumps are generated once for a session.
std::vector<Episode> episodesOf(std::uint64_t seed, int count, assess::SearchMode mode);
/// All of the task's blocks: training in `mode`, the others with full stiffness.
std::vector<Episode> blocksOf(const SearchSettings& task, std::uint64_t seed,
                              assess::SearchMode mode);

/// As its event in the record says it, and read again. Throws Error for invalid words.
std::string episodeText(const Episode& episode);
Episode episodeIn(const std::string& text);

/// What is under the hand in an episode.
haptics::SearchSurface surfaceOf(const haptics::SearchSpec& spec, const Episode& episode);

/// A floor with what its augmentations need, made whole.
struct MadeFloor {
  haptics::SearchSurface surface;
  std::optional<haptics::GaborTable> rises;
  std::optional<haptics::ValleyMap> valleys;
  haptics::Floor floor() const {
    return {&surface, rises ? &*rises : nullptr, valleys ? &*valleys : nullptr};
  }
};
/// Seconds of work where the episode is augmented, else none to speak of.
std::unique_ptr<MadeFloor> makeFloor(const SearchSettings& task, const Episode& episode);

/// The floors of a session, numbered from 1 as its trials are: each made beside the session, one
/// ahead, and kept until the one after the next is asked for. One thread prepares, the haptic
/// thread reads.
class Floors final : public runtime::FloorSource {
 public:
  Floors(const SearchSettings& task, const std::vector<Episode>& episodes)
      : task_(task), episodes_(episodes) {}

  /// Begins to make a floor, unless that was asked for before; nothing for numbers beyond the
  /// session's.
  void prepare(std::uint32_t number);
  /// Whether it is there; `wait`: it is, afterwards.
  bool ready(std::uint32_t number, bool wait);
  const haptics::Floor* floor(std::uint32_t number) const noexcept override;

 private:
  /// Three: the one that is felt, the one before it, which a late tick may still name, and the
  /// next.
  struct FloorSlot {
    std::atomic<std::uint32_t> number{0};
    std::uint32_t coming = 0;
    std::future<std::unique_ptr<MadeFloor>> making;
    std::unique_ptr<MadeFloor> made;
    haptics::Floor floor;
  };
  FloorSlot& slot(std::uint32_t number) { return slots_[number % slots_.size()]; }

  const SearchSettings& task_;
  const std::vector<Episode>& episodes_;
  std::array<FloorSlot, 3> slots_;
};

}  // namespace palpa::task_search
