#include <gtest/gtest.h>

#include "anatomy/parametric/phantoms.h"
#include "scene/view/framing.h"
#include "tests/scene/offscreen.h"

/// What a search by hand has felt and found, as pixels: a carpet, balls, pins, a ring.
namespace palpa::scene {
namespace {

constexpr int kColumns = 8, kRows = 6;
constexpr double kCellSide = 0.008;  // m, wide enough for a whole patch of pixels

const anatomy::Patient& block() {
  static const anatomy::Patient patient = anatomy::phantomBlock({0.1, 0.1, 0.05}, "block");
  return patient;
}

Vec3 onTop(double x, double y, double z = 0) { return anatomy::X_AP() * Vec3(x, y, z); }

CoverageGrid gridOf(std::uint8_t level) {
  return {anatomy::X_AP(), kCellSide, kCellSide,
          kColumns,        kRows,     std::vector<std::uint8_t>(kColumns * kRows, level)};
}

std::uint8_t& cell(CoverageGrid& grid, int column, int row) {
  return grid.levels.at(static_cast<std::size_t>(row * kColumns + column));
}

Vec3 middleOf(int column, int row) {
  return onTop((column + 0.5 - kColumns / 2.0) * kCellSide, (row + 0.5 - kRows / 2.0) * kCellSide);
}

class Search : public testing::Test {
 protected:
  Image frame() { return (view_.show(state_), view_.capture()); }
  Pixel seenAt(const Image& image, const Vec3& p_A) const {
    const Eigen::Vector2d px = project(state_.camera, state_.X_CA * p_A);
    return at(image, static_cast<int>(std::lround(px.x())), static_cast<int>(std::lround(px.y())));
  }
  const Image picture_ = plain(320, 240, 128);
  SceneState state_ = straightOn(picture_);
  SceneView view_{offscreen(), block(), {320, 240, FixedViews::none, true}};
};

double brightness(const Pixel& p) { return 0.2126 * p.r + 0.7152 * p.g + 0.0722 * p.b; }

TEST_F(Search, LevelsAreToldApartByBrightnessWhateverTheSkin) {
  CoverageGrid grid = gridOf(0);
  for (int level = 0; level < 4; ++level)
    cell(grid, 2 * level, 4) = static_cast<std::uint8_t>(level);
  for (const SkinStyle skin : {SkinStyle::translucent, SkinStyle::solid, SkinStyle::hidden}) {
    state_.skin = skin;
    state_.coverage.reset();
    const Image bare = frame();
    state_.coverage = grid;
    const Image with = frame();
    EXPECT_EQ(difference(seenAt(with, middleOf(0, 4)), seenAt(bare, middleOf(0, 4))), 0)
        << "a cell not felt stays clear";
    const Pixel light = seenAt(with, middleOf(2, 4)), medium = seenAt(with, middleOf(4, 4)),
                deep = seenAt(with, middleOf(6, 4));
    EXPECT_GT(difference(light, seenAt(bare, middleOf(2, 4))), 20);
    EXPECT_GT(difference(deep, seenAt(bare, middleOf(6, 4))), 40);
    EXPECT_GT(brightness(light) - brightness(medium), 20);
    EXPECT_GT(brightness(medium) - brightness(deep), 20);
  }
}

TEST_F(Search, ACellLiesWhereItsGridSaysAndNowhereElse) {
  state_.coverage = gridOf(0);
  const Image empty = frame();
  cell(*state_.coverage, 1, 5) = 3;  // left, far
  const Blob felt = clearlyChanged(frame(), empty);
  const Eigen::Vector2d middle = project(state_.camera, state_.X_CA * middleOf(1, 5));
  const double side = kCellSide * 300 / 0.4;
  EXPECT_NEAR(felt.u, middle.x(), 1);
  EXPECT_NEAR(felt.v, middle.y(), 1);
  EXPECT_LT(middle.x(), 150);
  EXPECT_LT(middle.y(), 110);
  EXPECT_NEAR(felt.count, side * side, 2.5 * side);
}

/// On a hill a cell is drawn where the hill is, and a cell that nobody asks for never.
TEST_F(Search, ACellLiesOnACurvedTop) {
  CoverageGrid grid = gridOf(0);
  grid.top.arch_high = 0.03;
  grid.top.arch_half_x = grid.top.arch_half_y = 0.05;
  grid.top = onOrigin(grid.top);
  const anatomy::Patient hill = anatomy::phantomBlock({0.1, 0.1, 0.05}, "hill", grid.top);
  SceneView view(offscreen(), hill, {320, 240, FixedViews::none, true});
  const auto shown = [&] { return (view.show(state_), view.capture()); };
  const Mat3 aside = Eigen::AngleAxisd(0.6, Vec3::UnitX()).toRotationMatrix();
  state_.X_CA = state_.X_CA * makePose(aside, Vec3::Zero());  // from above a height is not seen
  state_.coverage = grid;
  const Image empty = shown();
  cell(*state_.coverage, 7, 5) = 3;
  const Blob felt = changed(shown(), empty);
  const Vec3 level = middleOf(7, 5), p_P = anatomy::X_AP().inverse() * level;
  const Vec3 there = anatomy::X_AP() * fromTop(grid.top, Vec3(p_P.x(), p_P.y(), 0));
  const Eigen::Vector2d middle = project(state_.camera, state_.X_CA * there);
  EXPECT_NEAR(felt.u, middle.x(), 1.5);
  EXPECT_NEAR(felt.v, middle.y(), 1.5);
  EXPECT_GT((middle - project(state_.camera, state_.X_CA * level)).norm(), 2) << "lower";
  cell(*state_.coverage, 7, 5) = CoverageGrid::kNotAsked;
  EXPECT_EQ(changed(shown(), empty).count, 0);
}

TEST_F(Search, ThePictureShowsThroughWhatIsFelt) {
  state_.skin = SkinStyle::hidden;
  state_.coverage = gridOf(3);
  Image dark = plain(320, 240, 40), pale = plain(320, 240, 200);
  state_.picture = &dark;
  const Pixel on_dark = seenAt(frame(), middleOf(3, 3));
  state_.picture = &pale;
  const Pixel on_pale = seenAt(frame(), middleOf(3, 3));
  EXPECT_GT(on_pale.g - on_dark.g, 0.4 * 160);
  EXPECT_LT(on_pale.g - on_dark.g, 0.7 * 160);
}

TEST_F(Search, AnAreaNotYetFeltHasOnlyItsOutline) {
  const Image bare = frame();
  state_.coverage = gridOf(0);
  const Blob outline = clearlyChanged(frame(), bare);
  const double px = 300 / 0.4;
  EXPECT_NEAR(outline.right - outline.left, kColumns * kCellSide * px, 5);
  EXPECT_NEAR(outline.bottom - outline.top, kRows * kCellSide * px, 5);
  EXPECT_LT(outline.count, 2 * (kColumns + kRows) * kCellSide * px * 5)
      << "five pixels wide at most";
}

TEST_F(Search, NothingIsDrawnWithoutAnythingToShowOrWithBadGrids) {
  const Image bare = frame();
  CoverageGrid grid = gridOf(3);
  grid.levels.pop_back();
  state_.coverage = grid;
  EXPECT_EQ(changed(frame(), bare).count, 0) << "as many levels as cells";
  state_.coverage = CoverageGrid{};
  EXPECT_EQ(changed(frame(), bare).count, 0);
  state_.coverage = gridOf(3);
  state_.lumps = {{onTop(0, 0, -0.02), 0.008, true}};
  state_.marks_A = {onTop(0, 0)};
  state_.lead_A = onTop(0.01, 0);
  EXPECT_GT(changed(frame(), bare).count, 1000);
  state_.coverage.reset();
  state_.lumps.clear();
  state_.marks_A.clear();
  state_.lead_A.reset();
  EXPECT_EQ(changed(frame(), bare).count, 0) << "and nothing stays behind";
}

TEST_F(Search, IsNotDrawnOnAPictureThatIsNotRegistered) {
  state_.registered = false;
  const Image bare = frame();
  state_.coverage = gridOf(3);
  state_.lumps = {{onTop(0, 0, -0.02), 0.008, true}};
  state_.marks_A = {onTop(0, 0)};
  state_.lead_A = onTop(0.01, 0);
  EXPECT_EQ(changed(frame(), bare).count, 0);
}

TEST_F(Search, TheSameLevelsGiveTheSamePixelsAndOthersOthers) {
  state_.coverage = gridOf(1);
  const Image first = frame();
  EXPECT_EQ(changed(frame(), first).count, 0);
  cell(*state_.coverage, 3, 2) = 2;
  const Image second = frame();
  EXPECT_GT(changed(second, first).count, 20);
  cell(*state_.coverage, 3, 2) = 1;
  EXPECT_EQ(changed(frame(), first).count, 0);
  state_.coverage->X_AG.translation() += Vec3(0.01, 0, 0);
  EXPECT_GT(changed(frame(), first).count, 200) << "the carpet is laid anew where its grid goes";
  state_.coverage = gridOf(1);
  state_.coverage->columns = kRows;
  state_.coverage->rows = kColumns;
  EXPECT_GT(changed(frame(), first).count, 200) << "as many levels, other rows";
}

TEST_F(Search, LumpsAreSeenThroughEverySkinWhereTheyLie) {
  const ShownLump lump{onTop(0.02, -0.01, -0.02), 0.008, true};
  const Eigen::Vector2d middle = project(state_.camera, state_.X_CA * lump.p_A);
  for (const SkinStyle skin : {SkinStyle::translucent, SkinStyle::solid, SkinStyle::hidden}) {
    state_.skin = skin;
    state_.lumps.clear();
    const Image bare = frame();
    state_.lumps = {lump};
    const Image with = frame();
    const Blob ball = changed(with, bare);
    const double radius = 0.008 * 300 / 0.42;
    EXPECT_NEAR(ball.u, middle.x(), 1);
    EXPECT_NEAR(ball.v, middle.y(), 1);
    EXPECT_NEAR((ball.right - ball.left) / 2.0, radius + 1.5, 2);
    EXPECT_GT(difference(seenAt(with, lump.p_A), seenAt(bare, lump.p_A)), 25);
    // Round it a line that is brighter than what it encloses.
    const Pixel rim = at(with, static_cast<int>(std::lround(middle.x() - radius)),
                         static_cast<int>(std::lround(middle.y())));
    EXPECT_GT(difference(rim, seenAt(with, lump.p_A)), 15);
  }
}

TEST_F(Search, FoundAndMissedLumpsDifferInBrightness) {
  const Vec3 p_A = onTop(0, 0, -0.02);
  state_.lumps = {{p_A, 0.01, true}};
  const Pixel found = seenAt(frame(), p_A);
  state_.lumps = {{p_A, 0.01, false}};
  const Pixel missed = seenAt(frame(), p_A);
  EXPECT_GT(brightness(found) - brightness(missed), 25);
}

TEST_F(Search, AToolBeforeALumpHidesItAndTheCarpet) {
  state_.tool = Tool::probe;
  state_.show_tool = true;
  state_.X_AT = makePose(rotationWithZ(-Vec3::UnitZ()),
                         onTop(0, 0, 0.03) + Vec3(0, 0, -0.03));  // lies across, above the middle
  const Image bare = frame();
  state_.coverage = gridOf(3);
  state_.lumps = {{onTop(0, 0.005, -0.02), 0.004, true}};
  state_.lead_A = onTop(0, 0.005);
  const Image with = frame();
  EXPECT_EQ(difference(seenAt(with, onTop(0, 0.005, 0.03)), seenAt(bare, onTop(0, 0.005, 0.03))),
            0);
  EXPECT_GT(difference(seenAt(with, onTop(0.02, 0.005)), seenAt(bare, onTop(0.02, 0.005))), 30);
}

TEST_F(Search, PinsPointAtTheirPlacesAndCarryTheirNumbers) {
  const Image bare = frame();
  state_.marks_A = {onTop(-0.02, -0.02)};
  const Image one = frame();
  const Blob pin = changed(one, bare);
  const Eigen::Vector2d place = project(state_.camera, state_.X_CA * state_.marks_A[0]);
  EXPECT_NEAR(pin.bottom, place.y(), 2.5);
  EXPECT_NEAR((pin.left + pin.right) / 2.0, place.x(), 1.5);
  EXPECT_GT(place.y() - pin.top, 8);
  // The first of two is the same pin; a second one at the first's place is not.
  state_.marks_A = {onTop(-0.02, -0.02), onTop(0.02, 0.02)};
  const Image two = frame();
  EXPECT_EQ(
      blobOf(two,
             [&](int u, int v) { return u < 155 && difference(at(two, u, v), at(one, u, v)) > 2; })
          .count,
      0);
  std::swap(state_.marks_A[0], state_.marks_A[1]);
  const Image swapped = frame();
  const int number = blobOf(swapped, [&](int u, int v) {
                       return u < 155 && difference(at(swapped, u, v), at(two, u, v)) > 2;
                     }).count;
  EXPECT_GT(number, 2);
  EXPECT_LT(number, pin.count / 2);
}

TEST_F(Search, TheLeadIsARingOnTheSurface) {
  const Image bare = frame();
  state_.coverage = gridOf(0);
  const Image outline = frame();
  state_.lead_A = onTop(0.01, 0.005);
  const Image with = frame();
  const Blob ring = changed(with, outline);
  const Eigen::Vector2d middle = project(state_.camera, state_.X_CA * *state_.lead_A);
  EXPECT_NEAR((ring.left + ring.right) / 2.0, middle.x(), 1.5);
  EXPECT_NEAR((ring.top + ring.bottom) / 2.0, middle.y(), 1.5);
  EXPECT_EQ(difference(seenAt(with, *state_.lead_A), seenAt(bare, *state_.lead_A)), 0)
      << "its middle is free";
  state_.lead_A = onTop(-0.01, 0.005);
  const Blob moved = changed(frame(), outline);
  EXPECT_NEAR(ring.u - moved.u, 0.02 * 300 / 0.4, 1.5);
}

TEST(SearchInFixedViews, FromAboveTheFarSideIsUpAndFromTheSideTheTopIs) {
  SceneView view(offscreen(), block(), {900, 600, FixedViews::three, true});
  SceneState state;
  state.show_tool = false;
  const auto frame = [&] { return (view.show(state), view.capture()); };
  const Image bare = frame();
  const auto in = [&](const Image& image, int panel) {
    return blobOf(image, [&](int u, int v) {
      return u > 632 && v * 3 / 600 == panel && difference(at(image, u, v), at(bare, u, v)) > 8;
    });
  };
  const auto lumpAt = [&](double x, double y, double z) {
    state.lumps = {{onTop(x, y, z), 0.006, true}};
    return frame();
  };
  const Image middle = lumpAt(0, 0, -0.02), right = lumpAt(0.02, 0, -0.02),
              far = lumpAt(0, 0.02, -0.02), low = lumpAt(0, 0, -0.04);
  for (int panel = 0; panel < 3; ++panel) ASSERT_GT(in(middle, panel).count, 20) << panel;
  const double step = in(right, 0).u - in(middle, 0).u;
  EXPECT_GT(step, 10);
  EXPECT_NEAR(in(far, 0).v - in(middle, 0).v, -step, 1);
  EXPECT_NEAR(in(low, 0).v, in(middle, 0).v, 0.5);
  EXPECT_NEAR(in(far, 1).u - in(middle, 1).u, step, 1);
  EXPECT_NEAR(in(low, 1).v - in(middle, 1).v, step, 1);
  EXPECT_NEAR(in(right, 2).u - in(middle, 2).u, step, 1);
  EXPECT_NEAR(in(low, 2).v - in(middle, 2).v, step, 1);
  state.lumps.clear();
  state.coverage = gridOf(3);
  EXPECT_NEAR(in(frame(), 0).count, kColumns * kRows * std::pow(0.4 * step, 2),
              0.15 * kColumns * kRows * std::pow(0.4 * step, 2));  // cells of 8 mm, steps of 20
}

/// The whole block is in every fixed view, and there is something of it to see.
TEST(SearchInFixedViews, ShowAllOfABlock) {
  const Region region = regionOf(block());
  EXPECT_TRUE(region.only_skin);
  EXPECT_TRUE(region.on_table);
  EXPECT_GT(region.width, 0.1);
  EXPECT_GT(region.height, 0.1);
  EXPECT_LT(region.focus_A.norm(), 1e-12);
  const Region torso = regionOf(test::simplePatient());
  EXPECT_FALSE(torso.only_skin);
  EXPECT_FALSE(torso.on_table);
  EXPECT_EQ(torso.height, 0);
  SceneView view(offscreen(), block(), {900, 600, FixedViews::three, true});
  SceneState state;
  state.show_tool = false;
  view.show(state);
  const Image image = view.capture();
  for (int panel = 0; panel < 3; ++panel) {
    const Blob warm = blobOf(image, [&](int u, int v) {
      return u > 632 && v * 3 / 600 == panel && at(image, u, v).r > at(image, u, v).b + 8;
    });
    EXPECT_GT(warm.count, 3000) << panel;
    EXPECT_GT(warm.left, 640);
    EXPECT_LT(warm.right, 892);
    EXPECT_GT(warm.top, 200 * panel + 4);
    EXPECT_LT(warm.bottom, 200 * panel + 196);
  }
}

/// Both eyes of a stereo view see the carpet and what lies under it.
TEST(SearchInStereo, BothEyesSeeIt) {
  ViewLayout layout{640, 240, FixedViews::none, true};
  layout.stereo = Stereo::side_by_side;
  SceneView view(offscreen(), block(), layout);
  SceneState state;
  state.show_tool = false;
  view.show(state);
  const Image bare = view.capture();
  state.coverage = gridOf(3);
  state.lumps = {{onTop(0, 0, -0.02), 0.008, true}};
  state.marks_A = {onTop(0, 0)};
  view.show(state);
  const Image with = view.capture();
  const auto half = [&](bool right) {
    return blobOf(with,
                  [&](int u, int v) {
                    return (u >= 320) == right && difference(at(with, u, v), at(bare, u, v)) > 8;
                  })
        .count;
  };
  EXPECT_GT(half(false), 500);
  EXPECT_NEAR(half(true), half(false), 0.05 * half(false));
}

}  // namespace
}  // namespace palpa::scene
