#pragma once

#include <functional>

#include "anatomy/geometry/top_shape.h"
#include "apps/headset/headset_view.h"
#include "apps/runtime/activity.h"
#include "apps/runtime/channels.h"
#include "apps/runtime/clock.h"
#include "apps/runtime/device_adapters.h"
#include "apps/trial/keys.h"
#include "apps/trial/trial_status.h"
#include "apps/twin/hand.h"
#include "apps/twin/operator.h"
#include "scene/view/scene_view.h"

namespace palpa::session {

/// What a needle led by the mouse moves in.
struct MouseHandSetup {
  Pose X_DA, X_ET;
  twin::VisibleAnatomy anatomy;
  bool left_handed = false;
};

/// A person's hand without a haptic device: the mouse, or the controller of a headset, moves the
/// needle; what it would feel is drawn. Moving the mouse with the left button held shifts the tip
/// along the frontal plane, the wheel moves along the needle, the arrow keys turn it about its
/// entry, Z and X (left-handed: period and comma) draw and push the plunger, T changes the skin.
class MouseHand final : public runtime::Activity {
 public:
  MouseHand(const MouseHandSetup& setup, runtime::ChannelDevice& device, trial::Channels& channels,
            runtime::StopSwitch& stop);

  const char* name() const override { return "mouse"; }
  std::int64_t step(std::int64_t now_ns) override;  ///< 1 kHz: publishes the smoothed pose
  /// Called by the scene's thread with what the window reports.
  void handle(const scene::ViewInput& input, std::int64_t now_ns);
  /// Called by the scene's thread once a frame of a headset: its controller leads while it is
  /// tracked. One that is not seen any more holds the needle where it was, until the mouse is
  /// moved: from there the mouse leads on.
  void hold(const headset::HeldController& held, std::int64_t now_ns);
  void letGo(std::int64_t now_ns);  ///< the mouse leads again

 private:
  struct MouseRequest {
    Packed3 tip_A{};
    double turn_medial = 0, turn_cephalad = 0;  ///< rad, from the skin's normal
    double along = 0;                           ///< m, from the wheel
    double plunger = 0;
    bool held = false;  ///< by a controller: X_AT instead of what the mouse says
    PackedPose X_AT;
    PackedPose off = pack(
        Pose(Pose::Identity()));  ///< of the mouse's needle, since it took over from a controller
  };
  Pose pointedByMouse(const MouseRequest& request) const;
  MouseHandSetup setup_;
  runtime::ChannelDevice& device_;
  trial::Channels& channels_;
  runtime::StopSwitch& stop_;
  runtime::StateChannel<MouseRequest> requests_{runtime::TimeMode::real};
  MouseRequest request_;  // the scene thread's
  double mouse_x_ = 0, mouse_y_ = 0;
  bool dragging_ = false;
  std::int64_t seen_ns_ = 0;  // the controller
  // The mouse thread's, smoothed.
  Pose X_AT_;
  double plunger_ = 0;
  std::uint64_t sequence_ = 0;
  std::int64_t due_ns_ = -1;
};

/// Where a finger led by the mouse may go.
struct PointingHandSetup {
  Pose X_DP, X_ET;  ///< as the station knows them: what is pointed at is on the screen
  Pose X_AP;
  double half_x = 0, half_y = 0;  ///< m, P: it stays over the area
  twin::HandGrip grip;
  TopShape top = {};                                  ///< it presses along its normal
  std::function<Vec3(const Vec3& p_P)> to_area = {};  ///< of an area that is no rectangle
};

/// A person's finger at the virtual bench, led by the mouse: it hovers over the place of the
/// phantom's top that is pointed at in the AR view, goes down evenly while the left button is held,
/// and M marks. Nobody feels with a mouse: what the bench's sensor measures is drawn.
class PointingHand final : public twin::Hand {
 public:
  explicit PointingHand(const PointingHandSetup& setup);

  /// Called by the scene's thread with what the window reports and how it looks.
  void handle(const scene::ViewInput& input, const scene::ArGeometry& view, std::int64_t now_ns);

  Action act(const Senses& senses, double dt) override;  ///< the bench's thread
  const twin::HandGrip& grip() const override { return setup_.grip; }

 private:
  struct PointingRequest {
    double x = 0, y = 0;  ///< m, P
    bool press = false;
    int marks = 0;  ///< asked for so far
  };
  void move(const PointingRequest& request, double dt);

  const PointingHandSetup setup_;
  runtime::StateChannel<PointingRequest> requests_{runtime::TimeMode::real};
  PointingRequest request_;  // the scene thread's
  std::int64_t mark_key_ns_ = -1'000'000'000;
  Vec3 tip_P_ = Vec3::Zero();  // the bench thread's; along the top
  bool begun_ = false;
  int marked_ = 0;
  double mark_left_s_ = 0;
};

}  // namespace palpa::session
