#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "anatomy/base/error.h"
#include "apps/evidence/recorded_session.h"
#include "apps/session/comparison_session.h"
#include "apps/session/palpation_session.h"
#include "apps/session/pulse_session.h"
#include "apps/station/assets.h"
#include "apps/twin/phantom/phantom_file.h"
#include "quick_sessions.h"

/// Sessions on what is not the shipped silicone: one of four surfaces, an object with its map.
namespace palpa::session {
namespace {

namespace fs = std::filesystem;

/// An object stiffer toward +x, 60 to 180 N/m, as a calibration that passed.
fs::path mapFile(const fs::path& folder) {
  constexpr int kSide = 11;
  station::CalibrationFile file;
  file.kind = station::CalibrationKind::object;
  file.station = "palpation-bench";
  file.date = "2026-03-01T12:30:00Z";
  file.made_by = "a test";
  file.simulated = true;
  file.valid_days = 90;
  file.verdict = std::string(station::kPassed);
  file.covariance.resize(0, 0);
  file.residuals.unit = "1";
  std::vector<double> stiffness;
  for (int i = 0; i < kSide * kSide; ++i) stiffness.push_back(60.0 + 12.0 * (i % kSide));
  file.parameters = {
      {"depth_m", {3e-3}},
      {"low_m", {-0.05, -0.05}},
      {"high_m", {0.05, 0.05}},
      {"step_m", {0.01}},
      {"relaxation_time_s", {0.02, 0.2, 2}},
      {"relaxation_share", {0.02, 0.05, 0.04}},
      {"stiffness_N_per_m", stiffness},
      {"stiffness_sd_of_ln", std::vector<double>(kSide * kSide, 0.03)},
      {"friction", std::vector<double>(kSide * kSide, 0.4)},
  };
  station::writeCalibration(file, folder / "object.json");
  return folder / "object.json";
}

/// What the tick takes for the real thing there: N at 3 mm, pressed within half a second.
double believedAt(const haptics::TickConfig& tick, double x) {
  const haptics::StiffnessModulation law =
      haptics::lawAt(tick.touch.surface.contact, tick.touch.map, Vec3(x, 0.01, 0));
  return haptics::forceOf(law.real, 3e-3 - law.x0, 3e-3 / 0.5);
}

TEST(MappedObject, TheLoopsLawFollowsTheMap) {
  SessionOptions options = quick(OperatorKind::expert);
  const PalpationWorld plain(options);
  options.map = mapFile(freshPlace("map")).string();
  const PalpationWorld palpation(options);
  const haptics::TickConfig tick = palpation.tickConfig(options);
  // 2 % of 11 % of relaxation's shares are left over after half a second
  const double quicker = 1 + 0.02 * 0.04 + 0.05 * 0.3672 + 0.04 * 0.8848;
  for (const double x : {-0.04, 0.0, 0.025, 0.05})
    EXPECT_NEAR(believedAt(tick, x), 3e-3 * (120 + 1200 * x) * quicker, 2e-4) << x;
  EXPECT_NEAR(believedAt(tick, 0.09), believedAt(plain.tickConfig(options), 0), 1e-12)
      << "beyond the map: the one law";
  EXPECT_EQ(plain.tickConfig(options).touch.map.columns, 0);
  EXPECT_EQ(FrictionWorld(options).tickConfig(options).touch.map.columns, 11);
  EXPECT_EQ(PulseWorld(options).tickConfig(options).touch.map.columns, 11);
}

TEST(MappedObject, AMapThatDoesNotBelongThereIsRefused) {
  SessionOptions options = quick(OperatorKind::expert);
  const fs::path folder = freshPlace("maps"), path = mapFile(folder);
  const auto refused = [&](const auto& spoil) {
    station::CalibrationFile file = station::readCalibration(path);
    spoil(file);
    station::writeCalibration(file, folder / "spoilt.json");
    EXPECT_THROW(station::readMappedObject(folder / "spoilt.json", "palpation-bench"), Error);
  };
  refused([](auto& f) { f.station = "another"; });
  refused([](auto& f) { f.verdict = "touch it longer"; });
  refused([](auto& f) { f.kind = station::CalibrationKind::material; });
  const auto values = [](station::CalibrationFile& f, const std::string& name) {
    for (auto& parameter : f.parameters)
      if (parameter.name == name) return &parameter.values;
    throw std::out_of_range(name);
  };
  refused([&](auto& f) { values(f, "stiffness_N_per_m")->pop_back(); });
  refused([&](auto& f) { values(f, "stiffness_N_per_m")->at(7) = -1; });
  refused([&](auto& f) { values(f, "step_m")->at(0) = 0.001; });
  refused(
      [](auto& f) { std::erase_if(f.parameters, [](auto& p) { return p.name == "friction"; }); });
  options.surface = "ribs";
  EXPECT_THROW(PalpationWorld{options}, UsageError) << "it is not the same everywhere";
}

/// Twelve seconds on a block with ribs below: the evidence runs again with the same bits, and holds
/// the map as it was drawn.
TEST(MappedObject, ASessionOnItIsReplayedBitForBit) {
  SessionOptions options = quick(OperatorKind::expert);
  const fs::path folder = freshPlace("mapped");
  options.map = mapFile(folder).string();
  options.surface = "ribs";
  Quick<PalpationWorld> world(options);
  world.task.time_limit_s = 12;
  const PalpationRun run = runPalpation(options, world, folder);
  ASSERT_EQ(run.trials.size(), 1U);
  const record::SessionReader reader(folder / "session.palpa");
  EXPECT_EQ(reader.info().tick_config.touch.map.rows, 11);
  const evidence::ReplayCheck check = evidence::replayTicks(reader);
  EXPECT_GT(check.ticks, 11'000);
  EXPECT_EQ(check.different, 0);
  const auto session = nlohmann::json::parse(reader.info().session_json);
  const station::MappedObject recorded = station::mappedObjectIn(session.at("map"));
  EXPECT_EQ(recorded.stiffness, world.task.library.map->stiffness);
  EXPECT_EQ(recorded.columns, 11);
}

/// What sessions know of a surface was identified by pressing and stroking it; how near that is to
/// what it is, only a test may ask.
TEST(Surfaces, AreKnownAsTheyWereIdentified) {
  const fs::path file = station::assetFile("materials/surfaces.json");
  const std::vector<twin::SoftSurface> truths = twin::readSoftSurfaces(file);
  ASSERT_EQ(truths.size(), 4U);
  SessionOptions options = quick(OperatorKind::expert);
  const double plain = PalpationWorld(options).tickConfig(options).touch.surface.contact.real.k;
  double before_N = 0;
  for (const twin::SoftSurface& truth : truths) {
    options.surface = truth.name;
    const haptics::StiffnessModulation law =
        PalpationWorld(options).tickConfig(options).touch.surface.contact;
    EXPECT_NE(law.real.k, plain);
    const double at_4_mm = haptics::forceOf(law.real, 4e-3 - law.x0, 0),
                 hertz = 16.0 / 3 * truth.shear * std::sqrt(8e-3 * std::pow(4e-3, 3));
    EXPECT_NEAR(at_4_mm / hertz, 1.25, 0.25) << truth.name << ": a block on a plate is stiffer";
    EXPECT_GT(at_4_mm, 1.4 * before_N) << truth.name;
    EXPECT_NEAR(law.friction.mu, truth.law.mu, 0.15 * truth.law.mu) << truth.name;
    EXPECT_EQ(FrictionWorld(options).tickConfig(options).touch.surface.wanted.mu, law.friction.mu);
    before_N = at_4_mm;
  }
  options.surface = "ruber";
  EXPECT_THROW(PalpationWorld{options}, UsageError);
}

/// The softest and the hardest: the bench has the surface, and the loop has its law, so without a
/// lump nothing is added to speak of.
TEST(Surfaces, TheBenchHasWhatTheLoopKnows) {
  for (const char* name : {"oiled gel", "rubber"}) {
    SessionOptions options = quick(OperatorKind::expert, 3);
    options.surface = name;
    Quick<PalpationWorld> world(options);
    world.task.time_limit_s = 6;
    world.task.cases.lumps = {1};
    const fs::path folder = freshPlace("surface");
    runPalpation(options, world, folder);
    double hardest = 0, added = 0;
    record::SessionReader(folder / "session.palpa").ticks([&](const haptics::FlightRecord& tick) {
      hardest = std::max(hardest, unpack(tick.sensed.f_D).norm());
      added = std::max(added, unpack(tick.f_command_D).norm());
    });
    EXPECT_GT(hardest, 0.2) << name;
    EXPECT_LT(hardest, 6) << name;
    EXPECT_LT(added, 0.02 * hardest) << name;
  }
}

}  // namespace
}  // namespace palpa::session
