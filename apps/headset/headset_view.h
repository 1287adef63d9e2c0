#pragma once

#include <array>
#include <functional>
#include <memory>

#include "ar/headset/headset.h"
#include "scene/head_display.h"
#include "scene/scene_state.h"
#include "scene/view/scene_view.h"

namespace palpa::headset {

/// The camera of an eye for a picture of `width` x `height` pixels: u = fx X/Z + cx with pixel
/// centres at whole numbers, so that the tangents `left` .. `right` lie at -1/2 .. width - 1/2, and
/// `up` .. `down` at -1/2 .. height - 1/2.
scene::Pinhole pinholeOf(const ar::EyeView& eye, int width, int height);

/// Pose of W (+z up, +y away from the person) in L for a person whose eyes are there: `focus_W`,
/// what the work is about, lies before and below them, W's +y along the way they look, level.
Pose placeBefore(const std::array<ar::EyeView, 2>& eyes, const Vec3& focus_W);

/// What a controller says, in the patient's frame.
struct HeldController {
  bool tracked = false;
  Pose X_AT = Pose::Identity();  ///< the tool's tip, 0.10 m before the hand, where it points
  double plunger = 0;            ///< trigger, 0..1
  bool start = false;            ///< the button was pressed
};

/// What a headset shows, and to whom.
struct HeadsetViewSetup {
  Pose X_WA = Pose::Identity();
  Vec3 focus_A = Vec3::Zero();  ///< what lies before the person
  bool left_handed = false;
  scene::ForceColours force_colours = scene::ForceColours::paper;
  bool skin_deflection = false;
  bool inside = true;  ///< what lies under the skin is drawn
  ar::HeadsetPatience patience = {};
};

/// A headset that shows the scene: the patient lies before the person (again whenever they ask for
/// it, or their system recentres), the tool is in their hand. It has a context and a view of its
/// own; the desktop's go on beside it.
class HeadsetView final : public scene::HeadDisplay {
 public:
  /// Throws Error where there is no headset.
  HeadsetView(const anatomy::Patient& patient, HeadsetViewSetup setup);

  bool wait(bool may_place) override;
  void show(const scene::SceneState& state) override;
  void pulse(double seconds, double strength) override;
  std::string trouble() const override;
  std::string describe() const;
  /// Called once a frame
  void onHeld(std::function<void(const HeldController&)> action) { held_ = std::move(action); }
  std::uint64_t frames() const { return frames_; }  ///< shown
  int silences() const { return headset_->silences(); }

 private:
  std::size_t hand() const { return setup_.left_handed ? 0 : 1; }
  void reportHeld() const;
  void addView(const anatomy::Patient& patient);

  /// What a runtime that hangs with the context keeps.
  struct Drawing {
    std::unique_ptr<scene::GlContextProvider> context;
    std::unique_ptr<scene::SceneView> view;
    ~Drawing() { context->makeCurrent(); }
  };

  HeadsetViewSetup setup_;
  std::shared_ptr<Drawing> drawing_;
  std::unique_ptr<ar::Headset> headset_;  // goes before what it draws with
  int width_ = 0, height_ = 0;            ///< of one eye's half of the view
  ar::HeadsetFrame frame_;
  bool placed_ = false, asked_ = false;  ///< asked_: to be placed anew, as soon as that may be
  std::function<void(const HeldController&)> held_;
  Pose X_LA_ = Pose::Identity();
  std::uint64_t frames_ = 0;
};

}  // namespace palpa::headset
