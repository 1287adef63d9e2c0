#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "apps/record/session_file.h"
#include "program.h"

/// A palpation with a force sensor that fails in every way it can: named, no force, nothing lost.
namespace palpa::cli_test {
namespace {

nlohmann::json palpationStation() {
  return nlohmann::json::parse(contentOf(quickStation("palpation_bench.json")));
}

struct SensorFailure {
  const char* name;
  nlohmann::json fault;
  const char* words;
  bool ends;  ///< the trial; else force comes back with the sensor
};

class PalpationFault : public testing::TestWithParam<SensorFailure> {};

TEST_P(PalpationFault, IsNamedAndTakesTheForceAway) {
  const Folder here;
  nlohmann::json station = palpationStation();
  nlohmann::json fault = GetParam().fault;
  fault["kind"] = GetParam().name;
  fault["from_s"] = 6;
  fault["to_s"] = GetParam().ends ? 1000 : 8;
  station["twin"]["sensor_faults"] = {fault};
  const Outcome outcome =
      palpa(quickly({"palpation", "--operator", "expert", "--preset", "prostate", "--seed", "3",
                     "--station", here.file("faulty.json", station.dump()), "--out", "A"}),
            here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const record::SessionReader reader(here / "A/session.palpa");
  std::int64_t off_ns = -1, back_ns = -1;
  for (const runtime::Event& event : reader.events()) {
    if (off_ns < 0 && says(event.text, GetParam().words)) off_ns = event.t_ns;
    if (off_ns >= 0 && back_ns < 0 && event.text == "Force is back") back_ns = event.t_ns;
  }
  ASSERT_GE(off_ns, 6'000'000'000) << GetParam().words;
  EXPECT_LT(off_ns, 35'000'000'000);
  EXPECT_EQ(back_ns >= 0, !GetParam().ends);
  if (back_ns >= 0) {
    EXPECT_NEAR(1e-9 * static_cast<double>(back_ns), 8, 0.2);
  }
  double most_N = 0;
  const std::int64_t settled_ns = off_ns + 40'000'000;  // the task is told, and tells the loop
  reader.ticks([&](const haptics::FlightRecord& tick) {
    if (tick.t_ns > settled_ns && (back_ns < 0 || tick.t_ns < back_ns))
      most_N = std::max(most_N, unpack(tick.f_command_D).norm());
  });
  EXPECT_EQ(most_N, 0);
  EXPECT_EQ(reader.trials().at(0).end.outcome, GetParam().ends ? "void" : "done");
  EXPECT_TRUE(says(contentOf(here / "A/report.html"), GetParam().words));
  EXPECT_EQ(palpa({"replay", "A/session.palpa"}, here.path()).exit_code, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Every, PalpationFault,
    testing::Values(
        SensorFailure{"unplugged", {}, "the force sensor gave no usable reading", false},
        SensorFailure{"saturated", {}, "the force sensor gave no usable reading", false},
        SensorFailure{"drifting", {{"rate_N_per_s", 0.05}}, "it has drifted", true},
        SensorFailure{"reversed", nlohmann::json::object(), "its sign is wrong", true},
        SensorFailure{"wrong_scale", {{"factor", 3}}, "its scale is wrong", true},
        SensorFailure{"wrong_scale", {{"factor", 0.3}}, "wrong scale", true}),
    [](const auto& one) { return one.param.name + std::to_string(one.index); });

TEST(PalpationFaults, OneThatIsNoneIsRefused) {
  const Folder here;
  nlohmann::json station = palpationStation();
  station["twin"]["sensor_faults"] = {{{"kind", "tired"}, {"from_s", 1}, {"to_s", 2}}};
  const Outcome outcome =
      palpa({"palpation", "--fast", "--no-views", "--quiet", "--operator", "expert", "--station",
             here.file("faulty.json", station.dump()), "--out", "A"},
            here.path());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(says(outcome.err, "sensor_faults") &&
              says(outcome.err, "unplugged, saturated, drifting, reversed, wrong_scale"))
      << outcome.err;
}

}  // namespace
}  // namespace palpa::cli_test
