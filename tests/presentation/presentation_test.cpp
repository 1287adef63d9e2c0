#include "apps/presentation/presentation.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "apps/trial/shown.h"
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

TEST(Presentation, TextAndBack) {
  const Presentation pilot = readPresentation(shipped("pilot"));
  EXPECT_EQ(presentationOf(textOf(pilot), "a session"), pilot);
  const Presentation unfelt = withoutForces(Presentation{});
  EXPECT_EQ(presentationOf(textOf(unfelt), "a session"), unfelt);
  EXPECT_EQ(unfelt.name, "practice, forces not shown");
}

TEST(Presentation, SaysWhatIsShown) {
  EXPECT_EQ(describe(Presentation{}), "skin as chosen, three fixed views; everything is shown");
  Presentation one;
  one.skin = SkinLook::solid;
  one.views = FixedViews::one;
  one.arrows = one.newtons = false;
  EXPECT_EQ(describe(one),
            "solid skin, one fixed view at a time; not shown: force arrows, newtons");
}

TEST(Presentation, AMisspeltFieldIsRefused) {
  const auto with = [](const char* field, const nlohmann::json& value) {
    nlohmann::json text = nlohmann::json::parse(textOf(Presentation{}));
    text[field] = value;
    return text.dump();
  };
  EXPECT_THROW(presentationOf(with("arows", false), "it"), UsageError);
  EXPECT_THROW(presentationOf(with("skin", "glass"), "it"), UsageError);
  EXPECT_THROW(presentationOf(with("newtons", "no"), "it"), UsageError);
  EXPECT_THROW(presentationOf(with("version", 2), "it"), UsageError);
  EXPECT_NO_THROW(presentationOf(with("newtons", false), "it"));
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
  state.marks_A = {Vec3::Zero()};
  trial::keepShown(readPresentation(shipped("assessed")), &state);
  EXPECT_EQ(state.coverage->levels, (std::vector<std::uint8_t>{0, 0})) << "the outline stays";
  EXPECT_TRUE(state.lumps.empty());
  EXPECT_FALSE(state.lead_A);
  EXPECT_EQ(state.marks_A.size(), 1u);
}

}  // namespace
}  // namespace palpa::presentation
