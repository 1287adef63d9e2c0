#include <gtest/gtest.h>

#include "apps/trial/trial_scene.h"
#include "tests/support/simple_patient.h"

/// What is drawn, and when. Drawing without a graphics card takes a processor for itself.
namespace palpa::trial {
namespace {

/// Nothing but what every task shows; counts the frames that were put together.
class BareScene : public TrialScene {
 public:
  using TrialScene::TrialScene;
  int composed = 0;

 private:
  const TrialStatus& readStatus(std::int64_t) override { return status_; }
  void compose(scene::SceneState&, const runtime::ToolState&, const std::string&) override {
    ++composed;
  }
  TrialStatus status_;
};

class WhatIsDrawn : public testing::Test {
 protected:
  using Views = TrialScene::Views;

  std::unique_ptr<BareScene> sceneThat(Views views) {
    TrialScene::Stage stage;
    stage.views = views;
    stage.view = &view_;
    stage.wanted = [this](std::int64_t) { return wanted_; };
    stage.camera = {160, 120, 150, 150, 79.5, 59.5, {}, 0};
    return std::make_unique<BareScene>(stage, bus_, channels_);
  }
  bool isDrawn() const { return view_.capture().pixels != before_.pixels; }

  bool wanted_ = false;
  runtime::Bus bus_{runtime::TimeMode::virtual_time};
  Channels channels_;
  const std::unique_ptr<scene::GlContextProvider> context_ =
      scene::makeGlContext(scene::Display::offscreen, 160, 120, "test");
  scene::SceneView view_{
      *context_, test::simplePatient(), {160, 120, scene::FixedViews::none, true}};
  const scene::Image before_ = view_.capture();
};

TEST_F(WhatIsDrawn, NothingWhileNobodyLooks) {
  const auto scene = sceneThat(Views::pictures);
  for (int frame = 0; frame < 3; ++frame) scene->step(frame * 40'000'000);
  EXPECT_EQ(scene->composed, 3);
  EXPECT_FALSE(isDrawn());
}

TEST_F(WhatIsDrawn, AFrameThatSomebodyWants) {
  const auto scene = sceneThat(Views::pictures);
  scene->step(0);
  wanted_ = true;
  scene->step(40'000'000);
  EXPECT_TRUE(isDrawn());
}

TEST_F(WhatIsDrawn, EveryFrameOfAWindow) {
  const auto scene = sceneThat(Views::continuous);
  scene->step(0);
  EXPECT_TRUE(isDrawn());
}

TEST_F(WhatIsDrawn, NothingWithoutViews) {
  wanted_ = true;
  const auto scene = sceneThat(Views::none);
  scene->step(0);
  EXPECT_FALSE(isDrawn());
}

}  // namespace
}  // namespace palpa::trial
