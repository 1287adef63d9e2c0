#pragma once

#include <gtest/gtest.h>

#include "apps/headset/headset_view.h"
#include "tests/support/simple_patient.h"
#include "tests/support/test_xr.h"

/// A headset of the test runtime on a head, before which a ball lies.
namespace palpa::headset {

/// Whoever waits as long as it takes: a busy computer takes no frame from a test.
inline HeadsetViewSetup unhurried() {
  HeadsetViewSetup setup;
  setup.patience.frame = setup.patience.silent = setup.patience.opening = setup.patience.closing =
      std::chrono::seconds(60);
  return setup;
}

struct Worn {
  explicit Worn(const std::string& plan, double ball = 0.03, HeadsetViewSetup setup = unhurried())
      : xr(PALPA_TEST_XR_JSON, plan), patient(test::spherePatient(setup.focus_A, ball)) {
    view = std::make_unique<HeadsetView>(patient, std::move(setup));
  }
  /// Frames that were shown of `count` that were tried.
  int show(int count, const scene::SceneState& state = bare()) {
    int shown = 0;
    for (int i = 0; i < count; ++i) {
      if (!view->wait(true)) continue;
      view->show(state);
      ++shown;
    }
    return shown;
  }
  test::XrReport over() {
    view.reset();
    return xr.report();
  }
  static scene::SceneState bare() {
    scene::SceneState state;
    state.show_tool = false;
    return state;
  }

  test::TestXr xr;
  anatomy::Patient patient;
  std::unique_ptr<HeadsetView> view;
};

/// What was opened was closed, and nothing was done that the specification forbids.
inline void expectClean(const test::XrReport& report, const std::string& plan) {
  EXPECT_TRUE(report.written) << plan;
  EXPECT_EQ(report.open, std::vector<std::string>{}) << plan;
  EXPECT_EQ(report.complaints, std::vector<std::string>{}) << plan;
}

inline int calls(const test::XrReport& report, const std::string& name) {
  const auto found = report.calls.find(name);
  return found == report.calls.end() ? 0 : found->second;
}

}  // namespace palpa::headset
