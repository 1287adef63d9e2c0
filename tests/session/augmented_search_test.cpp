#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "apps/record/session_file.h"
#include "apps/session/search_session.h"
#include "tests/session/quick_sessions.h"
#include "tests/support/counts.h"

/// Augmented searches of a simulated person, tick by tick: nothing but the floor and the cues is
/// felt, unless a port that has truly made energy is damped.
namespace palpa::session {
namespace {

/// What the hand has put into the port, counted apart from the loop's observer: by the floor's
/// force and the attraction, which act in the floor's plane; pushes and reliefs act along its
/// normal and heed no motion.
class Port {
 public:
  Port(const haptics::TickConfig& config, const Pose& X_FD)
      : limits_(config.passivity),
        X_FD_(X_FD),
        weight_D_(config.floor.weight_N * (X_FD.rotation().transpose() * Vec3::UnitZ())) {}

  /// Energy before this tick's own force, J.
  double energy(const haptics::FlightRecord& record) {
    const Vec3 p_D = unpack(record.reading.p_DE);
    const Vec3 dx = started_ ? Vec3(p_D - last_p_D_) : Vec3::Zero();
    energy_ += -last_f_D_.dot(dx) + limits_.coulomb * dx.norm();
    const double expected = energy_ - closed(record).dot(dx) + limits_.coulomb * dx.norm();
    energy_ = std::min(energy_, closed(record).norm() * limits_.reach);
    if (energy_ < 0) energy_ *= 1 - 0.001 / limits_.forget_tau;
    // What the hand got, the damping with it, without the handle's weight and without the cues that
    // heed no motion.
    const Vec3 cue = unpack(record.f_augmentation_D) - pull(record);
    last_f_D_ = unpack(record.f_command_D) - cue - weight_D_;
    last_p_D_ = p_D;
    started_ = true;
    return expected;
  }

 private:
  Vec3 pull(const haptics::FlightRecord& record) const {
    Vec3 f_F = X_FD_.rotation() * unpack(record.f_augmentation_D);
    f_F.z() = 0;
    return X_FD_.rotation().transpose() * f_F;
  }
  Vec3 closed(const haptics::FlightRecord& record) const {
    return unpack(record.f_contact_D) + pull(record);
  }

  haptics::PassivityLimits limits_;
  Pose X_FD_;
  Vec3 weight_D_;
  Vec3 last_f_D_ = Vec3::Zero(), last_p_D_ = Vec3::Zero();
  double energy_ = 0;
  bool started_ = false;
};

struct Seen {
  long ticks = 0, damped = 0, unexplained = 0, in_air = 0;
  double strongest_pull_N = 0, largest_N = 0;
};

Seen look(const std::filesystem::path& file, const SearchWorld& world,
          const SessionOptions& options) {
  const haptics::TickConfig config = world.tickConfig(options);
  Port port(config, unpack(config.X_DF).inverse());
  const double weight_N = world.rendering.weight_N;
  const Vec3 up_D = unpack(config.X_DF).rotation() * Vec3::UnitZ();
  Seen seen;
  record::SessionReader(file).ticks([&](const haptics::FlightRecord& record) {
    const double energy = port.energy(record);
    if (!record.commands.armed || record.commands.held || record.commands.trial == 0) return;
    ++seen.ticks;
    const Vec3 floor = unpack(record.f_contact_D), cue = unpack(record.f_augmentation_D);
    const double off = (unpack(record.f_wanted_D) - floor - cue - weight_N * up_D).norm();
    seen.strongest_pull_N = std::max(seen.strongest_pull_N, (cue - cue.dot(up_D) * up_D).norm());
    if (off <= 0.05) return;
    ++seen.damped;
    seen.largest_N = std::max(seen.largest_N, off);
    seen.in_air += floor.isZero() && cue.isZero();
    // Half of what nobody feels: the observer may act only below all of it, and this account adds
    // up in another order.
    seen.unexplained += energy >= -config.passivity.unfelt_J / 2;
  });
  return seen;
}

TEST(AugmentedSearch, NothingIsFeltButFloorAndCues) {
  SessionOptions options = quick(OperatorKind::expert, 4001);
  options.command = "search";
  options.mode = "augmented";
  options.trials = test::counted(2, 50);
  Quick<SearchWorld> world(options);
  const std::filesystem::path folder = freshPlace("augmented_search");
  EXPECT_EQ(runSearch(options, world, folder).trials.size(),
            static_cast<std::size_t>(options.trials));
  const Seen seen = look(folder / "session.palpa", world, options);
  std::printf(
      "%d augmented episodes, %ld ticks: damped by more than 0.05 N in %ld, at most by %.2f N; in "
      "free air %ld; without energy made %ld; pull into a valley at most %.2f N\n",
      options.trials, seen.ticks, seen.damped, seen.largest_N, seen.in_air, seen.unexplained,
      seen.strongest_pull_N);
  EXPECT_GT(seen.ticks, 1000);
  EXPECT_GT(seen.strongest_pull_N, 0.2) << "the attraction is there";
  EXPECT_EQ(seen.unexplained, 0);
  EXPECT_EQ(seen.in_air, 0);
}

}  // namespace
}  // namespace palpa::session
