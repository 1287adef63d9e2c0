#include "apps/headset/headset_view.h"

#include <algorithm>

namespace palpa::headset {
namespace {

constexpr double
    kAhead = 0.45,
    kBelow = 0.25;  // m from the eyes: within reach of a bent arm, looked down on as at a table
constexpr double kLevel =
    0.3;  // less of the gaze than this is level: they look straight up or down

/// Between the eyes.
Vec3 headOf(const std::array<ar::EyeView, 2>& eyes) {
  return 0.5 * (eyes[0].X_LE.translation() + eyes[1].X_LE.translation());
}

}  // namespace

scene::Pinhole pinholeOf(const ar::EyeView& eye, int width, int height) {
  scene::Pinhole camera;
  camera.width = width;
  camera.height = height;
  camera.fx = width / (eye.right - eye.left);
  camera.fy = height / (eye.up - eye.down);
  camera.cx = -0.5 - camera.fx * eye.left;
  camera.cy = -0.5 + camera.fy * eye.up;
  return camera;
}

Pose placeBefore(const std::array<ar::EyeView, 2>& eyes, const Vec3& focus_W) {
  const auto level = [](Vec3 v) {
    v.z() = 0;
    return v;
  };
  Vec3 ahead = level(0.5 * (eyes[0].X_LE.linear().col(2) + eyes[1].X_LE.linear().col(2)));
  // Who looks down has the top of the head toward what is ahead, who looks up the chin.
  const Vec3 gaze = eyes[0].X_LE.linear().col(2), top = -eyes[0].X_LE.linear().col(1);
  if (ahead.norm() < kLevel) ahead = level(gaze.z() < 0 ? top : Vec3(-top));
  if (ahead.norm() < kLevel) ahead = Vec3::UnitY();
  ahead.normalize();
  Mat3 R_LW;
  R_LW << ahead.cross(Vec3::UnitZ()), ahead, Vec3::UnitZ();
  const Vec3 focus_L = headOf(eyes) + kAhead * ahead - kBelow * Vec3::UnitZ();
  return makePose(R_LW, focus_L - R_LW * focus_W);
}

namespace {

constexpr double kReach = 0.10;  // m from the hand to the tool's tip

ar::GlBinding bindingOf(const scene::NativeContext& native) {
  ar::GlBinding gl;
  gl.kind = native.glx ? ar::GlPlatform::glx : ar::GlPlatform::egl;
  gl.display = native.display;
  gl.config = native.config;
  gl.context = native.context;
  gl.drawable = native.drawable;
  gl.visual = native.visual;
  gl.address = native.address;
  return gl;
}

}  // namespace

HeadsetView::HeadsetView(const anatomy::Patient& patient, HeadsetViewSetup setup)
    : setup_(std::move(setup)),
      drawing_(new Drawing{
          scene::makeGlContext(scene::Display::offscreen, 64, 64, "Palpa, headset"), nullptr}) {
  ar::GlBinding gl = bindingOf(drawing_->context->native());
  gl.owner = drawing_;
  headset_ = ar::openHeadset(gl, setup_.patience);
  drawing_->context->makeCurrent();
  addView(patient);
}

/// Both eyes side by side in one window, as large as the larger of them.
void HeadsetView::addView(const anatomy::Patient& patient) {
  for (const ar::EyeView& eye : headset_->eyes()) {
    width_ = std::max(width_, eye.width);
    height_ = std::max(height_, eye.height);
  }
  scene::ViewLayout layout;
  layout.width = 2 * width_;
  layout.height = height_;
  layout.fixed_views = scene::FixedViews::none;
  layout.free_navigation = false;
  layout.inside = setup_.inside;
  layout.stereo = scene::Stereo::headset;
  layout.see_through = headset_->blend() != ar::Blend::opaque;
  layout.force_colours = setup_.force_colours;
  layout.skin_deflection = setup_.skin_deflection;
  drawing_->view = std::make_unique<scene::SceneView>(*drawing_->context, patient, layout);
}

bool HeadsetView::wait(bool may_place) {
  if (headset_->state() == ar::HeadsetState::lost) return false;
  const std::optional<ar::HeadsetFrame> frame = headset_->begin();
  if (!frame) return false;
  frame_ = *frame;
  asked_ |= frame_.recentred;
  if (frame_.head_known && (!placed_ || (asked_ && may_place))) {
    X_LA_ = placeBefore(frame_.eyes, setup_.X_WA * setup_.focus_A) * setup_.X_WA;
    placed_ = true;
    asked_ = false;
  }
  reportHeld();
  return true;
}

void HeadsetView::reportHeld() const {
  if (!held_ || !placed_) return;
  const ar::HandInput& hand_now = frame_.hands[hand()];
  const Pose X_GT = makePose(Mat3::Identity(), Vec3(0, 0, kReach));
  held_({hand_now.tracked, X_LA_.inverse() * hand_now.X_LG * X_GT, hand_now.trigger, frame_.start});
}

void HeadsetView::show(const scene::SceneState& state) {
  const bool draw = frame_.draw && placed_;
  if (draw) {
    scene::SceneState seen = state;
    std::array<scene::EyeCamera, 2> eyes;
    for (std::size_t i = 0; i < 2; ++i)
      eyes[i] = {pinholeOf(frame_.eyes[i], width_, height_), frame_.eyes[i].X_LE.inverse() * X_LA_};
    seen.picture = nullptr;
    seen.registered = true;
    seen.camera = eyes[0].camera;
    seen.X_CA = eyes[0].X_CA;
    seen.eyes = eyes;
    seen.tip_covariance_A.reset();  // of the camera's overlay
    seen.hud.overlay.clear();
    drawing_->view->show(seen);
  }
  drawing_->context->makeCurrent();
  const ar::Headset::Draw copy = [&](std::size_t eye, const ar::EyeTexture& picture) {
    drawing_->view->copyEye(eye, {picture.texture, picture.format, picture.width, picture.height});
  };
  headset_->end(draw ? copy : ar::Headset::Draw());
  frames_ += draw;
}

void HeadsetView::pulse(double seconds, double strength) {
  headset_->vibrate(hand(), seconds, strength);
}

std::string HeadsetView::trouble() const { return headset_->trouble(); }

std::string HeadsetView::describe() const { return headset_->describe(); }

}  // namespace palpa::headset
