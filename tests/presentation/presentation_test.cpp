#include "apps/presentation/presentation.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/trial/trial_scene.h"
#include "tests/support/files.h"

namespace palpa::presentation {
namespace {

std::filesystem::path shipped(const std::string& name) {
  return std::string(PALPA_SOURCE_DIR) + "/assets/presentations/" + name + ".json";
}

TEST(Presentation, TheShippedSetsAreWhatTheirNamesSay) {
  const Presentation practice = readPresentation(shipped("practice")),
                     assessed = readPresentation(shipped("assessed")),
                     pilot = readPresentation(shipped("pilot")),
                     substitution = readPresentation(shipped("substitution"));
  EXPECT_EQ(practice.views, FixedViews::three);
  EXPECT_TRUE(replacesFeeling(practice));
  EXPECT_TRUE(unaided(assessed));
  EXPECT_EQ(assessed.views, FixedViews::none);
  EXPECT_TRUE(unaided(pilot));
  EXPECT_FALSE(unaided(practice));
  EXPECT_FALSE(unaided(substitution));
  EXPECT_TRUE(substitution.arrows && substitution.newtons);
  EXPECT_FALSE(substitution.tissue_words || substitution.contact_words || substitution.trail);
}

/// Tzafestas et al. (2008), section 3.2, point by point: no navigation, three fixed orthographic
/// views that the user switches between, the skin not shown to give way.
TEST(Presentation, ThePilotIsItsSources) {
  const Presentation pilot = readPresentation(shipped("pilot"));
  EXPECT_FALSE(pilot.navigation);
  EXPECT_EQ(pilot.views, FixedViews::one);
  EXPECT_FALSE(pilot.skin_deflection);
  EXPECT_FALSE(replacesFeeling(pilot));
}

TEST(Presentation, WhatIsRecordedCanBeReadAgain) {
  const std::filesystem::path here = test::freshFolder("presentation", "recorded");
  const Presentation unfelt = withoutForces(readPresentation(shipped("practice")));
  EXPECT_EQ(unfelt.name, "practice, forces not shown");
  EXPECT_FALSE(replacesFeeling(unfelt));
  writeWhole(here / "own.json", jsonOf(unfelt).dump());
  EXPECT_EQ(readPresentation(here / "own.json"), unfelt);
}

TEST(Presentation, IsFoundByItsNameOrAsAFile) {
  const std::filesystem::path here = test::freshFolder("presentation", "named");
  const std::filesystem::path sets = shipped("pilot").parent_path();
  writeWhole(here / "own.json", jsonOf(Presentation{}).dump());
  EXPECT_EQ(presentationNamed("pilot", sets, "", "--presentation").name, "pilot");
  EXPECT_EQ(presentationNamed("own.json", sets, here, "--presentation"), Presentation{});
  try {
    presentationNamed("pilto", sets, "", "--presentation");
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("assessed, pilot, practice, substitution"),
              std::string::npos)
        << error.what();
  }
}

TEST(Presentation, SaysWhatIsShown) {
  EXPECT_EQ(describe(Presentation{}), "skin as chosen, three fixed views; everything may be shown");
  Presentation one;
  one.skin = SkinLook::solid;
  one.views = FixedViews::one;
  one.arrows = one.newtons = false;
  EXPECT_EQ(describe(one),
            "solid skin, one fixed view at a time; not shown: force arrows, newtons");
}

TEST(Presentation, AMisspeltFieldIsRefused) {
  const std::filesystem::path here = test::freshFolder("presentation", "fields");
  const auto readWith = [&](const char* field, const nlohmann::json& value) {
    nlohmann::json json = jsonOf(Presentation{});
    json[field] = value;
    writeWhole(here / "own.json", json.dump());
    readPresentation(here / "own.json");
  };
  EXPECT_THROW(readWith("arows", false), UsageError);
  EXPECT_THROW(readWith("skin", "glass"), UsageError);
  EXPECT_THROW(readWith("newtons", "no"), UsageError);
  EXPECT_THROW(readWith("version", 2), UsageError);
  EXPECT_NO_THROW(readWith("newtons", false));
}

TEST(Presentation, AKeyChangesOnlyASkinThatIsFree) {
  using scene::SkinStyle;
  Presentation shown;
  EXPECT_EQ(trial::firstSkin(shown), SkinStyle::translucent);
  EXPECT_EQ(trial::nextSkin(shown, SkinStyle::translucent), SkinStyle::solid);
  EXPECT_EQ(trial::nextSkin(shown, SkinStyle::hidden), SkinStyle::translucent);
  shown.skin = SkinLook::solid;
  EXPECT_EQ(trial::firstSkin(shown), SkinStyle::solid);
  EXPECT_EQ(trial::nextSkin(shown, SkinStyle::solid), SkinStyle::solid);
}

/// What palpation adds: what was felt, lumps seen through the skin, a ring that leads.
TEST(Presentation, AMapOfWhatWasFeltLeads) {
  scene::SceneState state;
  state.coverage = scene::CoverageGrid{};
  state.coverage->columns = 2;
  state.coverage->rows = 1;
  state.coverage->levels = {1, 3};
  state.lumps = {scene::ShownLump{}};
  state.lead_A = Vec3::Zero();
  state.tip_covariance_A = Mat3::Identity();
  state.marks_A = {Vec3::Zero()};
  trial::keepShown(readPresentation(shipped("assessed")), &state);
  EXPECT_EQ(state.coverage->levels, (std::vector<std::uint8_t>{0, 0})) << "the outline stays";
  EXPECT_TRUE(state.lumps.empty());
  EXPECT_FALSE(state.lead_A);
  EXPECT_FALSE(state.tip_covariance_A) << "it would show where the hidden tip is";
  EXPECT_EQ(state.skin, scene::SkinStyle::solid);
  EXPECT_EQ(state.marks_A.size(), 1u);
}

}  // namespace
}  // namespace palpa::presentation
