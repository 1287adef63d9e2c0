#include "apps/task_palpation/palpation_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "anatomy/base/error.h"
#include "apps/station/calibration_file.h"
#include "tests/support/scratch_folder.h"

namespace palpa::task_palpation {
namespace {

const std::filesystem::path kAssets = std::filesystem::path(PALPA_SOURCE_DIR) / "assets";

nlohmann::json jsonOf(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return nlohmann::json::parse(stream);
}

/// A copy of the shipped task with its lumps, to be spoilt.
class Copy {
 public:
  Copy() : folder_("palpation_file") {
    std::filesystem::create_directories(folder_ / "tasks");
    std::filesystem::copy(kAssets / "materials", folder_ / "materials",
                          std::filesystem::copy_options::recursive);
    task = jsonOf(kAssets / "tasks/palpation_breast.json");
  }
  nlohmann::json task;
  std::filesystem::path lumps() const { return folder_ / "materials/lumps.json"; }
  void write(const std::filesystem::path& file, const nlohmann::json& json) {
    std::ofstream(file) << json.dump();
  }
  /// What is said of it; empty: it is taken.
  std::string refusal() {
    write(folder_ / "tasks/task.json", task);
    try {
      readPalpation(folder_ / "tasks/task.json");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

 private:
  test::ScratchFolder folder_;
};

bool has(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

TEST(PalpationFile, TheShippedOnesAreTaken) {
  for (const char* name :
       {"palpation_breast.json", "palpation_abdomen.json", "palpation_prostate.json"}) {
    const PalpationSettings settings = readPalpation(kAssets / "tasks" / name);
    EXPECT_FALSE(settings.title.empty());
    EXPECT_EQ(settings.library.kinds.size(), 8u);
    EXPECT_TRUE(settings.library.simulated);
    EXPECT_FALSE(settings.taxonomy.haptic.empty());
    EXPECT_TRUE(settings.seen_as);
  }
  EXPECT_EQ(Copy().refusal(), "");
}

/// Everything of a case lies where it is searched and below the curved top, as deep as the law of
/// its lump was identified.
TEST(PalpationFile, TheCurvedOnesHoldTheirLumpsBelowTheirTops) {
  for (const char* name : {"palpation_breast_curved", "palpation_abdomen_curved",
                           "palpation_prostate_curved", "palpation_neck", "palpation_forearm"}) {
    const PalpationSettings task = readPalpation(kAssets / "tasks" / (std::string(name) + ".json"));
    const assess::SearchArea& area = task.scoring.rules.area;
    EXPECT_FALSE(area.top.flat()) << name;
    std::size_t lumps = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      const Case in_case = drawCase(task, seed);
      lumps += in_case.size();
      const haptics::PlacedLumps lie = placed(in_case, {}, 1, area.top);
      for (std::size_t i = 0; i < in_case.size(); ++i) {
        EXPECT_GE(assess::insideBy(area, in_case[i].p_P), task.cases.margin - 1e-6) << name;
        const Vec3 n = normalOf(area.top, in_case[i].p_P.x(), in_case[i].p_P.y()),
                   over = unpack(lie[i].p_T0) + task.library.kinds[in_case[i].kind].depth * n;
        EXPECT_LT((over - assess::onTop(area, in_case[i].p_P)).norm(), 1e-12) << name;
        EXPECT_NEAR(n.x(), static_cast<double>(lie[i].n[0]), 1e-6);
      }
    }
    EXPECT_GE(lumps, 20u) << name;
  }
}

TEST(PalpationFile, ATopThatNoHandCanFollowIsRefused) {
  const auto refusalOf = [](const nlohmann::json& shape) {
    Copy copy;
    copy.task["phantom"]["shape"] = shape;
    return copy.refusal();
  };
  const nlohmann::json good = {{"arch_high_mm", 15},
                               {"arch_half_across_mm", 60},
                               {"arch_half_away_mm", 60},
                               {"arch_foot_mm", 8}};
  EXPECT_EQ(refusalOf(good), "");
  nlohmann::json steep = good, narrow = good, endless = good;
  steep["arch_high_mm"] = 45;
  steep["arch_half_across_mm"] = 40;
  narrow["mounds"] = {{{"across_mm", 0}, {"away_mm", 0}, {"high_mm", -3}, {"wide_across_mm", 4}}};
  endless["mounds"] = {{{"across_mm", 0}, {"away_mm", 0}, {"high_mm", 3}}};
  EXPECT_TRUE(has(refusalOf(steep), "steeper than 45 degrees"));
  EXPECT_TRUE(has(refusalOf(narrow), "narrower than the tip"));
  EXPECT_TRUE(has(refusalOf(endless), "wide_across_mm"));
  Copy outlined;
  outlined.task["area"]["outline_mm"] = {{-20, -20}, {31, 0}, {0, 20}};
  EXPECT_TRUE(has(outlined.refusal(), "beyond the rectangle"));
  Copy real;
  real.task = jsonOf(kAssets / "tasks/palpation_taken.json");
  real.task["phantom"]["shape"] = good;
  EXPECT_TRUE(has(real.refusal(), "real_lump"));
}

TEST(PalpationFile, ARealLumpIsFeltInHalfOfTheCasesAndTakenAwayInTheOthers) {
  const PalpationSettings settings = readPalpation(kAssets / "tasks/palpation_taken.json");
  ASSERT_TRUE(settings.real);
  int taken = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const Case in_case = drawCase(settings, seed);
    const std::size_t felt = lumpsOf(in_case, settings.library).size();
    const haptics::PlacedLumps lumps = placed(in_case, settings.anatomy, 0.8);
    const auto share = [](const haptics::PlacedLump& lump) { return lump.taken; };
    const bool away = takesAway(in_case);
    taken += away;
    EXPECT_EQ(felt, in_case.size() - (away ? 1 : 0));
    EXPECT_EQ(std::count_if(lumps.begin(), lumps.end(),
                            [&](const auto& lump) { return share(lump) == 0.8F; }),
              away ? 1 : 0)
        << "where it is felt nothing is added for it";
    EXPECT_FALSE(takesAway(withoutForce(in_case)));
    EXPECT_EQ(lumpsOf(withoutForce(in_case), settings.library).size(), in_case.size());
    for (const LumpInCase& lump : in_case)
      if (lump.is == LumpIs::computed) {
        EXPECT_GE((lump.p_P - settings.real->lump.p_P).head<2>().norm(), 0.026 - 1e-12);
      }
  }
  EXPECT_NEAR(taken / 400.0, 0.5, 0.1);
}

TEST(PalpationFile, NormalAnatomyIsInEveryCaseAndLumpsKeepAwayFromIt) {
  const PalpationSettings abdomen = readPalpation(kAssets / "tasks/palpation_abdomen.json");
  ASSERT_EQ(abdomen.scoring.rules.normal.size(), 1u);
  EXPECT_EQ(abdomen.anatomy.size(), abdomen.scoring.rules.normal[0].line_P.size());
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Case in_case = drawCase(abdomen, seed);
    for (const LumpInCase& lump : in_case)
      EXPECT_EQ(
          assess::anatomyAt(abdomen.scoring.rules.normal, lump.p_P, abdomen.scoring.rules.reach),
          nullptr)
          << seed;
    const haptics::PlacedLumps lumps = placed(in_case, abdomen.anatomy);
    EXPECT_EQ(std::count_if(lumps.begin(), lumps.end(),
                            [](const haptics::PlacedLump& lump) { return lump.kind != 0; }),
              static_cast<std::ptrdiff_t>(in_case.size() + abdomen.anatomy.size()));
  }
}

TEST(PalpationFile, AnatomyThatCannotBeMeantIsRefused) {
  const nlohmann::json good = {
      {{"name", "a rib"}, {"kind", "middle"}, {"width_mm", 10}, {"line_mm", {{-10, 0}, {10, 0}}}}};
  const auto refusalWith = [&](const char* field, const nlohmann::json& value) {
    Copy copy;
    copy.task["cases"]["apart_mm"] = 12;
    copy.task["anatomy"] = good;
    copy.task["anatomy"][0][field] = value;
    return copy.refusal();
  };
  EXPECT_EQ(refusalWith("name", "a rib"), "");
  EXPECT_TRUE(has(refusalWith("name", 3), "anatomy"));
  EXPECT_TRUE(has(refusalWith("kind", "bone"), "which the library of lumps does not hold"));
  EXPECT_TRUE(has(refusalWith("width_mm", -1), "anatomy"));
  EXPECT_TRUE(has(refusalWith("line_mm", {{0, 0, 0}}), "a point [across, away]"));
  EXPECT_TRUE(has(refusalWith("line_mm", {{48, 0}}), "would stick out of the phantom"));
  EXPECT_TRUE(
      has(refusalWith("line_mm", {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}), "points of"));
}

TEST(PalpationFile, EveryShippedLumpIsWorthFinding) {
  for (const station::LumpKind& kind : station::readLumps(kAssets / "materials/lumps.json").kinds)
    EXPECT_GE(kind.contrast, 0.15) << kind.name;
}

TEST(PalpationFile, NamesWhatIsWrong) {
  {
    Copy copy;
    copy.task["phantom"]["seen_as"] = "knee";
    EXPECT_TRUE(has(copy.refusal(), "breast, abdomen, prostate or neck"));
  }
  {
    Copy copy;
    copy.task["phantom"]["high_mm"] = 25;
    EXPECT_TRUE(has(copy.refusal(), "stick out of the phantom"));
  }
  {
    Copy copy;
    copy.task["area"]["half_across_mm"] = 49;
    copy.task["cases"]["margin_mm"] = 0;
    EXPECT_TRUE(has(copy.refusal(), "stick out of the phantom"));
  }
  {
    Copy copy;
    copy.task["pressure"]["too_hard_N"] = 0.5;
    EXPECT_TRUE(has(copy.refusal(), "more than deep"));
  }
  {
    Copy copy;
    copy.task["area"]["half_across_mm"] = 60;
    EXPECT_TRUE(has(copy.refusal(), "larger than the phantom"));
  }
  {
    Copy copy;
    copy.task["cases"]["lumps"] = {0.5, 0.2};
    EXPECT_TRUE(has(copy.refusal(), "add up to 1"));
  }
  {
    Copy copy;
    copy.task["cases"]["apart_mm"] = 60;
    EXPECT_TRUE(has(copy.refusal(), "no room"));
  }
  {
    Copy copy;
    copy.task["cases"]["kinds"] = {"a pea"};
    EXPECT_TRUE(has(copy.refusal(), "a pea"));
  }
  {
    Copy copy;
    copy.task["pressure"]["medium_N"] = 0.9;
    EXPECT_TRUE(has(copy.refusal(), "must rise"));
  }
  {
    Copy copy;
    copy.task["engine"] = "needle";
    EXPECT_TRUE(has(copy.refusal(), "palpation"));
  }
}

/// A changed calibration is told by its checksum; so these are written anew.
void spoil(const Copy& copy, const std::string& file, const std::string& parameter, double value) {
  const std::filesystem::path path = copy.lumps().parent_path() / "lumps" / file;
  station::CalibrationFile calibration = station::readCalibration(path);
  for (auto& numbers : calibration.parameters)
    if (numbers.name == parameter) numbers.values = {value};
  station::writeCalibration(calibration, path);
}

TEST(LumpLibrary, RefusesLawsThatNoSoftThingHas) {
  const struct {
    const char *file, *parameter;
    double value;
    const char* words;
  } cases[] = {{"material.json", "k_N_per_m_to_the_m", -1, "k below zero"},
               {"material.json", "m", 0.8, "within 1.0 to 2.0"},
               {"material.json", "m", 2.3, "within 1.0 to 2.0"},
               {"hard.json", "H_T_k_N_per_m_to_the_m", -5, "H_T_k below zero"},
               {"hard.json", "H_T_m", 2.5, "within 1.0 to 2.0"},
               {"hard.json", "G_z_m", 4, "within 0.5 to 3.0"},
               {"hard.json", "l0_m", 0, "has no depth"}};
  for (const auto& c : cases) {
    Copy copy;
    spoil(copy, c.file, c.parameter, c.value);
    const std::string said = copy.refusal();
    EXPECT_TRUE(has(said, c.words)) << said;
    EXPECT_TRUE(has(said, c.file)) << said;
  }
}

TEST(LumpLibrary, RefusesAnotherCalibrationAndOneThatFailed) {
  Copy copy;
  nlohmann::json lumps = jsonOf(copy.lumps());
  lumps["surface"] = "lumps/friction.json";
  copy.write(copy.lumps(), lumps);
  EXPECT_TRUE(has(copy.refusal(), "not of \"material\""));
}

TEST(PalpationCase, TheSameForASeedAndWithinTheArea) {
  const PalpationSettings settings = readPalpation(kAssets / "tasks/palpation_breast.json");
  const assess::SearchArea& area = settings.scoring.rules.area;
  std::array<int, 5> counts{};
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const Case one = drawCase(settings, seed), again = drawCase(settings, seed);
    ASSERT_EQ(one.size(), again.size());
    ++counts.at(one.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i].p_P, again[i].p_P);
      EXPECT_LE(std::abs(one[i].p_P.x()), area.half_x - settings.cases.margin);
      EXPECT_LE(std::abs(one[i].p_P.y()), area.half_y - settings.cases.margin);
      EXPECT_EQ(-one[i].p_P.z(), settings.library.kinds[one[i].kind].depth);
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GE((one[i].p_P - one[j].p_P).head<2>().norm(), settings.cases.apart);
    }
  }
  for (std::size_t n = 0; n < settings.cases.lumps.size(); ++n)
    EXPECT_NEAR(counts[n] / 400.0, settings.cases.lumps[n], 4 * std::sqrt(0.25 / 400))
        << n;  // four standard deviations of a share
}

TEST(PalpationCase, OneInFourHasNoLump) {
  const PalpationSettings settings = readPalpation(kAssets / "tasks/palpation_prostate.json");
  int least = 4, most = 0;
  for (std::uint64_t four = 0; four < 100; ++four) {
    int clear = 0;
    for (std::uint64_t k = 0; k < 4; ++k) clear += drawCase(settings, 4 * four + k).empty();
    least = std::min(least, clear);
    most = std::max(most, clear);
  }
  EXPECT_EQ(least, 1);
  EXPECT_GE(most, 2) << "the prostate's three in ten are more than one in four";
}

TEST(PalpationCase, NoneHasNoLumpWhereTheTaskWantsNone) {
  PalpationSettings settings = readPalpation(kAssets / "tasks/palpation_prostate.json");
  settings.cases.lumps = {0, 0.5, 0.5};
  for (std::uint64_t seed = 0; seed < 100; ++seed) EXPECT_FALSE(drawCase(settings, seed).empty());
}

TEST(PalpationCase, LumpsThatHardlyFitAreRefusedBeforeAnythingStarts) {
  Copy copy;
  copy.task["cases"]["lumps"] = {0.2, 0.2, 0.2, 0.2, 0.2};
  copy.task["cases"]["apart_mm"] = 47.9;  // four would have to lie in the very corners of 48 mm
  EXPECT_TRUE(has(copy.refusal(), "no room"));
}

TEST(PalpationCase, IsPlacedForTheLoop) {
  const haptics::PlacedLumps lumps = placed({{2, {0.01, 0.02, -0.018}}}, {});
  EXPECT_EQ(lumps[0].kind, 3u);
  EXPECT_EQ(lumps[0].p_T0, (Packed3{0.01, 0.02, -0.018}));
  EXPECT_EQ(lumps[1].kind, 0u);
}

}  // namespace
}  // namespace palpa::task_palpation
