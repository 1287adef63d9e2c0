#include "apps/task_needle/scene_activity.h"

#include <algorithm>
#include <cstdio>
#include <opencv2/imgproc.hpp>

#include "apps/runtime/camera_words.h"
#include "apps/task_needle/hud_text.h"

namespace palpa::task_needle {
namespace {

constexpr std::int64_t kFramePeriod = 33'333'333, kBesideHeadset = 100'000'000;   // ns, of the desktop's view: beside a headset it is for whoever looks on
constexpr double kBoneFelt = 0.1;                                             // N
constexpr double kBonePulse = 0.08, kPuncturePulse = 0.03, kPunctureStrength = 0.6;   // s; [chosen] to be told apart
constexpr double kTrailStep = 0.0005;   // m between points of the trail
constexpr std::size_t kTrailLongest = 4000;

scene::Image toImage(const cv::Mat& picture) {
  cv::Mat rgb;
  cv::cvtColor(picture, rgb, picture.channels() == 1 ? cv::COLOR_GRAY2RGB : cv::COLOR_BGR2RGB);
  scene::Image image{rgb.cols, rgb.rows, 3, {}};
  image.pixels.assign(rgb.datastart, rgb.dataend);
  return image;
}

}  // namespace

SceneActivity::SceneActivity(const Setup& setup, runtime::Bus& bus, TaskChannels& channels)
    : setup_(setup),
      bus_(bus),
      channels_(channels),
      undistorter_(setup.camera),
      X_AD_((setup.X_WD.inverse() * setup.X_WA).inverse()) {
  const calibration::CameraModel& p = undistorter_.pinhole();
  state_.camera = {p.width, p.height, p.fx, p.fy, p.cx, p.cy};
  state_.guide = setup.guide;
  if (setup.giving_way) skin_.emplace(*setup.giving_way, setup.skin);
}

void SceneActivity::cycleSkin() {
  state_.skin = state_.skin == scene::SkinStyle::translucent ? scene::SkinStyle::solid
                : state_.skin == scene::SkinStyle::solid     ? scene::SkinStyle::hidden
                                                             : scene::SkinStyle::translucent;
}

std::int64_t SceneActivity::step(std::int64_t now_ns) {
  now_ns_ = now_ns;
  if (setup_.view && setup_.input) setup_.input(setup_.view->poll(), now_ns);   // before whatever makes it wait
  const bool worn = setup_.head && setup_.head->wait(tool_.phase == haptics::NeedlePhase::outside);
  follow(now_ns);
  compose();
  tellOperator(now_ns);
  if (worn) showOnHead();
  if (worn && now_ns < next_frame_ns_) return now_ns;
  next_frame_ns_ = now_ns + (worn ? kBesideHeadset : kFramePeriod);
  if (setup_.views == Views::continuous) render();
  if (setup_.views != Views::none) keepPictures();
  return worn ? now_ns : next_frame_ns_;
}

void SceneActivity::finish(std::int64_t now_ns) {
  now_ns_ = now_ns;
  follow(now_ns);
  compose();
  if (setup_.views != Views::none) keepPictures();
}

/// And tells the hand what a controller can: a layer punctured, bone.
void SceneActivity::showOnHead() {
  setup_.head->show(state_);
  const bool inserted = tool_.phase == haptics::NeedlePhase::inserted;
  const bool punctured = inserted && (felt_.phase != haptics::NeedlePhase::inserted || (felt_.tissue != tool_.tissue && tool_.depth > felt_.depth));
  if (tool_.bone_force > kBoneFelt && felt_.bone_force <= kBoneFelt) setup_.head->pulse(kBonePulse, 1);
  else if (punctured) setup_.head->pulse(kPuncturePulse, kPunctureStrength);
  felt_ = tool_;
}

void SceneActivity::follow(std::int64_t now_ns) {
  if (const TaskStatus* status = channels_.status_to_scene.read(now_ns)) status_ = *status;
  if (const runtime::ToolState* tool = bus_.haptic_to_scene.read(now_ns)) tool_ = *tool;
  const runtime::CameraView* view = bus_.camera_to_scene.read(now_ns);
  if (!view || view->number == last_number_) return;
  last_number_ = view->number;
  camera_ = *view;
  fresh_picture_ = view->picture && view->fault != ar::PictureFault::wrong_size;
  if (view->pose) board_ = view->pose;
  if (!view->X_CW) return;
  X_CW_ = *view->X_CW;
  registered_ = true;
}

void SceneActivity::compose() {
  std::string trouble = runtime::cameraTrouble(camera_ ? &*camera_ : nullptr, now_ns_);
  if (trouble.empty()) {
    const auto displaced = runtime::displacedBoard(*camera_, setup_.places, displaced_);
    displaced_ = displaced ? std::optional(displaced->board) : std::nullopt;
    if (displaced) trouble = displaced->words;
  }
  state_.registered = registered_;
  state_.X_CA = X_CW_ * setup_.X_WA;
  state_.X_AT = X_AD_ * unpack(tool_.X_DT);
  if (skin_) state_.skin_push = skin_->follow(tool_, X_AD_, now_ns_);
  state_.plunger = tool_.plunger;
  state_.blood = status_.blood;
  const std::string head = setup_.head ? setup_.head->trouble() : "";
  state_.hud = hudText(status_, tool_, trouble.empty() ? head : trouble, setup_.mark);
  state_.tip_covariance_A = setup_.tip_covariance_A && setup_.view && trouble.empty() ? setup_.tip_covariance_A(unpack(tool_.X_DT)) : std::nullopt;
  state_.hud.overlay = state_.tip_covariance_A ? overlayText(*state_.tip_covariance_A) : "";
  hideBehindRealThings();
  state_.forces.clear();
  const Vec3 f_A = X_AD_.rotation() * unpack(tool_.f_contact_D);
  if (f_A.norm() > 0.05) {
    const Vec3 tip = state_.X_AT.translation();
    state_.forces.push_back({scene::ForceKind::reaction, tip, f_A});
    const Vec3 felt = X_AD_.rotation() * unpack(tool_.f_command_D);
    if (felt.norm() > 0.05)
      state_.forces.push_back({scene::ForceKind::device, (X_AD_ * unpack(tool_.X_DT)) * Vec3(0, 0, -0.11), felt});
  }
  if (status_.trial != trail_trial_) {
    trail_trial_ = status_.trial;
    state_.trail_A.clear();
  }
  const Vec3 tip = state_.X_AT.translation();
  if (status_.state == TrialState::running && tool_.phase != haptics::NeedlePhase::outside &&
      state_.trail_A.size() < kTrailLongest &&
      (state_.trail_A.empty() || (tip - state_.trail_A.back()).norm() > kTrailStep))
    state_.trail_A.push_back(tip);
}

/// Those on a board that is not seen hide nothing.
void SceneActivity::hideBehindRealThings() {
  state_.occluders.clear();
  for (const RealThing& thing : setup_.things) {
    const station::RealThing& place = *thing.place;
    if (place.on == station::RealThing::On::table) {
      state_.occluders.push_back({thing.mesh, setup_.X_WA.inverse() * place.X});
    } else if (place.on == station::RealThing::On::tool) {
      state_.occluders.push_back({thing.mesh, state_.X_AT * place.X});
    } else {
      const bool seen = camera_ && place.board < camera_->others.size() && camera_->others[place.board];
      state_.occluders.push_back({seen ? thing.mesh : nullptr, seen ? state_.X_CA.inverse() * *camera_->others[place.board] * place.X : Pose::Identity()});
    }
  }
}

void SceneActivity::tellOperator(std::int64_t now_ns) {
  runtime::Displayed displayed;
  displayed.t_ns = now_ns;
  displayed.X_AT = state_.X_AT;
  displayed.trial = status_.trial;
  displayed.running = status_.state == TrialState::running;
  displayed.blood_flows = status_.blood_flows;
  displayed.injury = displayed.running && injury(tool_);
  bus_.scene_to_operator.publish(displayed, now_ns + setup_.display_latency_ns);
}

void SceneActivity::render() {
  if (fresh_picture_ && camera_ && camera_->picture) {
    background_ = toImage(undistorter_.apply(*camera_->picture));
    fresh_picture_ = false;
  }
  state_.picture = background_.pixels.empty() ? nullptr : &background_;
  setup_.view->show(state_);
}

void SceneActivity::keepPictures() {
  PictureRequest moment;
  while (channels_.pictures_to_scene.pop(&moment)) {
    char stem[96];
    std::snprintf(stem, sizeof stem, "view-%02d-%02zu-%s", moment.trial, pictures_.size() + 1,
                  moment.label.c_str());
    save(stem, moment);
  }
  if (!setup_.every_source_picture || !camera_ || !fresh_picture_) return;
  const std::string source = std::filesystem::path(camera_->source).stem().string();
  if (std::find(kept_sources_.begin(), kept_sources_.end(), source) != kept_sources_.end()) return;
  kept_sources_.push_back(source);
  save("view-" + source, {status_.trial, status_.elapsed_s, source,
                          camera_->pose ? "Registered on " + source : "No board found in " + source});
}

void SceneActivity::save(const std::string& stem, const PictureRequest& moment) {
  render();
  const std::filesystem::path file = setup_.folder / (stem + ".png");
  scene::writePng(setup_.view->capture(), file.string());
  pictures_.push_back({file, moment});
}

}  // namespace palpa::task_needle
