#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkPropCollection.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "scene/overlay/hud.h"

/// Words and the tool beside each other, in windows from the smallest to the largest.
namespace palpa::scene {
namespace {

Hud someWords() {
  Hud hud;
  hud.phase = "Trial 2 of 6  phase 2: advance to the vein";
  hud.depth = "12 mm inserted, in fat";
  hud.force = "1.2 N";
  hud.time = "0:31";
  hud.touched = "clavicle (guide)";
  hud.overlay = "within 0.4 mm";
  hud.mark = "SIMULATED OPERATOR";
  hud.notice = "Pull the plunger while you advance";
  return hud;
}

/// A syringe that points from anywhere at the sides to somewhere in the middle.
Surroundings tool(std::mt19937& bits, const Rect& panel, bool left_hand) {
  std::uniform_real_distribution<double> share(0, 1);
  const Eigen::Vector2d tip(panel.x + (0.25 + 0.5 * share(bits)) * panel.width,
                            panel.y + (0.2 + 0.6 * share(bits)) * panel.height);
  const double length = (0.3 + 0.4 * share(bits)) * panel.height;
  const double angle = (share(bits) - 0.5) * 0.9 * std::numbers::pi;
  const Eigen::Vector2d back((left_hand ? -1 : 1) * std::cos(angle), std::sin(angle));
  const Eigen::Vector2d hub = tip + 0.45 * length * back;
  return {{{tip, hub, 0.004 * length}, {hub, tip + length * back, 0.055 * length}}, {tip}};
}

struct Window {
  int width, height;
};
class HudRoom : public testing::TestWithParam<Window> {
 protected:
  Rect panel() const {
    return layoutPanels(GetParam().width, GetParam().height, FixedViews::three).ar;
  }
  void show(const Surroundings& around) {
    hud_.update(someWords(), {{ForceKind::device, Vec3::Zero(), Vec3(1, 0, 0)}}, panel(),
                textSize_px(GetParam().height), around);
  }
  vtkNew<vtkRenderer> renderer_;
  HudPainter hud_{*renderer_};
};
INSTANTIATE_TEST_SUITE_P(Windows, HudRoom,
                         testing::Values(Window{320, 240}, Window{640, 360}, Window{400, 900},
                                         Window{1280, 720}, Window{1920, 1080},
                                         Window{3840, 2160}));

TEST_P(HudRoom, NoPlateCoversTipOrToolInEitherHand) {
  std::mt19937 bits(7);
  int would_cover = 0;
  show({});
  const std::vector<Rect> alone = hud_.plates();
  for (const bool left_hand : {false, true})
    for (int i = 0; i < 200; ++i) {
      const Surroundings around = tool(bits, panel(), left_hand);
      show(around);
      const std::vector<Rect> plates = hud_.plates();
      for (const Rect& plate : plates)
        EXPECT_TRUE(isClear(plate, around, panel())) << "plate at " << plate.x << ", " << plate.y;
      for (const Rect& plate : alone)
        if (!isClear(plate, around, panel())) ++would_cover;
    }
  EXPECT_GT(would_cover, 50) << "of what lies where it always did";
}

/// What has no room for that is not drawn.
TEST_P(HudRoom, NoTextIsSmallerThanElevenPixelsNorOutsideItsPanel) {
  show({});
  const Rect p = panel();
  for (const Rect& plate : hud_.plates()) {
    EXPECT_GE(plate.x, p.x);
    EXPECT_LE(plate.right(), p.right());
    EXPECT_GE(plate.y, p.y);
    EXPECT_LE(plate.top(), p.top());
  }
  int words = 0;
  vtkPropCollection* props = renderer_->GetViewProps();
  for (int i = 0; i < props->GetNumberOfItems(); ++i) {
    auto* text = vtkTextActor::SafeDownCast(props->GetItemAsObject(i));
    if (!text || !text->GetVisibility()) continue;
    EXPECT_GE(text->GetTextProperty()->GetFontSize(), 11) << text->GetInput();
    ++words;
  }
  EXPECT_GT(words, 3);
}

TEST_P(HudRoom, NothingMovesThatIsNotInTheWay) {
  show({});
  const std::vector<Rect> alone = hud_.plates();
  const Rect p = panel();
  int free = 0;
  for (int i = 0; i < 400; ++i) {
    Surroundings somewhere;
    somewhere.points = {
        {p.x + (i % 20 + 0.5) / 20 * p.width, p.y + (i / 20 + 0.5) / 20.0 * p.height}};
    if (!std::all_of(alone.begin(), alone.end(),
                     [&](const Rect& plate) { return isClear(plate, somewhere, p); }))
      continue;
    ++free;
    show(somewhere);
    EXPECT_EQ(hud_.plates(), alone) << "a point at " << somewhere.points[0].transpose();
  }
  EXPECT_GT(free, 40) << "of 400 places";
}

TEST_P(HudRoom, ComesBackWhenTheToolIsGone) {
  show({});
  const std::size_t all = hud_.plates().size();
  const Rect p = panel();
  Surroundings across;  // along the lower edge, so that neither side is free
  across.tool = {{Eigen::Vector2d(p.x, p.y + 0.1 * p.height),
                  Eigen::Vector2d(p.right(), p.y + 0.1 * p.height), 0.08 * p.height}};
  show(across);
  EXPECT_LT(hud_.plates().size(), all);
  show({});
  EXPECT_EQ(hud_.plates().size(), all);
}

}  // namespace
}  // namespace palpa::scene
