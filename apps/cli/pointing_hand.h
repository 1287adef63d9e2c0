#pragma once

#include "apps/runtime/state_channel.h"
#include "apps/twin/hand.h"
#include "scene/scene_view.h"

namespace palpa::cli {

/// A person's finger at the virtual bench, led by the mouse: it hovers over the place of the
/// phantom's top that is pointed at in the AR view, goes down evenly while the left button is held,
/// and M marks. Nobody feels with a mouse: what the bench's sensor measures is drawn.
class PointingHand final : public twin::Hand {
 public:
  struct Setup {
    Pose X_DP, X_ET;  ///< as the station knows them: what is pointed at is on the screen
    Pose X_AP;
    double half_x = 0, half_y = 0;  ///< m, P: it stays over the area
    twin::HandGrip grip;
  };
  explicit PointingHand(const Setup& setup);

  /// Called by the scene's thread with what the window reports and how it looks.
  void handle(const scene::ViewInput& input, const scene::ArGeometry& view, std::int64_t now_ns);

  Action act(const Senses& senses, double dt) override;  ///< the bench's thread
  const twin::HandGrip& grip() const override { return setup_.grip; }

 private:
  struct Wish {
    double x = 0, y = 0;  ///< m, P
    bool press = false;
    int marks = 0;  ///< asked for so far
  };
  void move(const Wish& wish, double dt);

  const Setup setup_;
  runtime::StateChannel<Wish> wishes_{runtime::TimeMode::real};
  Wish wish_;  // the scene thread's
  std::int64_t mark_key_ns_ = -1'000'000'000;
  Vec3 tip_P_ = Vec3::Zero();  // the bench thread's
  bool begun_ = false;
  int marked_ = 0;
  double mark_left_s_ = 0;
};

}  // namespace palpa::cli
