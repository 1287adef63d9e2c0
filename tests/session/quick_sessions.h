#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "apps/session/needle_session.h"
#include "tests/support/files.h"

/// Sessions of simulated persons, as fast as they can be.
namespace palpa::session {

inline SessionOptions quick(OperatorKind who, std::uint64_t seed = 1) {
  SessionOptions options;
  options.who = who;
  options.seed = seed;
  options.fast = options.no_views = options.quiet = true;
  options.display = scene::Display::offscreen;
  options.tracking = Tracking::model;
  return options;
}

/// Pictures change no score; sessions whose board is tracked in them draw few.
template <typename World>
struct Quick : World {
  explicit Quick(const SessionOptions& options) : World(options) {
    this->station.camera_rate_Hz = 1;
  }
};

inline std::filesystem::path freshPlace(const std::string& name) {
  return test::freshFolder("session", name);
}

/// A trial of each seed from 1 on is given to `each`, with the folder of its session.
template <typename Each>
void trySeeds(SessionOptions options, NeedleWorld& world, int seeds, const Each& each) {
  for (int i = 0; i < seeds; ++i) {
    options.seed = 1 + static_cast<std::uint64_t>(i);
    const std::filesystem::path folder = freshPlace("seeds");
    each(runNeedleSession(options, world, folder).trials.at(0), folder);
  }
}

}  // namespace palpa::session
