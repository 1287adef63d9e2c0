#include "apps/trial/trial_scene.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

#include <opencv2/imgproc.hpp>

#include "apps/runtime/camera_trouble.h"

namespace palpa::trial {
using presentation::Presentation;
using presentation::SkinLook;
using scene::SkinStyle;

void keepShown(const Presentation& shown, scene::SceneState* state) {
  if (!shown.arrows) state->forces.clear();
  if (!shown.trail) state->trail_A.clear();
  if (!shown.anatomy) {  // an ellipse over solid skin would show where the hidden tip is
    state->lumps.clear();
    state->tip_covariance_A.reset();
  }
  if (shown.skin != SkinLook::free) state->skin = firstSkin(shown);
  if (!shown.skin_deflection) state->skin_push.reset();
  if (!shown.newtons) state->hud.force.clear();
  if (!shown.tissue_words) state->hud.depth.clear();
  if (!shown.contact_words) state->hud.touched.clear();
  if (shown.guidance) return;
  state->guide.reset();
  state->lead_A.reset();
  state->surface_map = nullptr;
  if (state->coverage)
    std::fill(state->coverage->levels.begin(), state->coverage->levels.end(), std::uint8_t{0});
}

SkinStyle firstSkin(const Presentation& shown) {
  return shown.skin == SkinLook::solid ? SkinStyle::solid : SkinStyle::translucent;
}

SkinStyle nextSkin(const Presentation& shown, SkinStyle now) {
  if (shown.skin != SkinLook::free) return now;
  return now == SkinStyle::translucent ? SkinStyle::solid
         : now == SkinStyle::solid     ? SkinStyle::hidden
                                       : SkinStyle::translucent;
}

namespace {

// ns, of the desktop's view: beside a headset it is for whoever looks on
constexpr std::int64_t kFramePeriod = 33'333'333, kBesideHeadset = 100'000'000;

scene::Image toImage(const cv::Mat& picture) {
  cv::Mat rgb;
  cv::cvtColor(picture, rgb, picture.channels() == 1 ? cv::COLOR_GRAY2RGB : cv::COLOR_BGR2RGB);
  scene::Image image{rgb.cols, rgb.rows, 3, {}};
  image.pixels.assign(rgb.datastart, rgb.dataend);
  return image;
}

}  // namespace

TrialScene::TrialScene(const Stage& stage, runtime::Bus& bus, Channels& channels)
    : stage_(stage),
      bus_(bus),
      channels_(channels),
      undistorter_(stage.camera),
      X_AD_((stage.X_WD.inverse() * stage.X_WA).inverse()) {
  const calibration::CameraModel& p = undistorter_.pinhole();
  state_.camera = {p.width, p.height, p.fx, p.fy, p.cx, p.cy};
  state_.skin = firstSkin(stage.shown);
}

/// T: the skin's look. V: the next fixed view. ? or F1: the keys.
void TrialScene::handle(const scene::ViewInput& input) {
  for (const std::string& key : input.keys) {
    if (key == "t") state_.skin = nextSkin(stage_.shown, state_.skin);
    if (key == "question" || key == "F1") help_ = !help_;
    if (key == "v") state_.fixed_view = (state_.fixed_view + 1) % scene::kFixedViews;
  }
}

std::int64_t TrialScene::step(std::int64_t now_ns) {
  now_ns_ = now_ns;
  if (stage_.view && stage_.input) {  // before whatever makes it wait
    const scene::ViewInput input = stage_.view->poll();
    handle(input);
    stage_.input(input, now_ns);
  }
  const bool worn = stage_.head && stage_.head->wait(mayWait(tool_));
  follow(now_ns);
  composeAll();
  informOperator(now_ns);
  channels_.frames.fetch_add(1, std::memory_order_relaxed);
  if (worn) {
    stage_.head->show(state_);
    pulse(*stage_.head, tool_);
  }
  if (worn && now_ns < next_frame_ns_) return now_ns;
  next_frame_ns_ = now_ns + (worn ? kBesideHeadset : kFramePeriod);
  const bool wanted = stage_.wanted && stage_.wanted(now_ns);
  if (stage_.views == Views::continuous || (stage_.views == Views::pictures && wanted)) render();
  if (stage_.views != Views::none) keepPictures();
  if (stage_.watch) stage_.watch(state_, *status_, now_ns);
  return worn ? now_ns : next_frame_ns_;
}

void TrialScene::finish(std::int64_t now_ns) {
  now_ns_ = now_ns;
  follow(now_ns);
  composeAll();
  if (stage_.views != Views::none) keepPictures();
  writer_.finish();
}

void TrialScene::follow(std::int64_t now_ns) {
  status_ = &readStatus(now_ns);
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

/// Of the camera or of a board that is displaced.
std::string TrialScene::trouble() {
  std::string words = runtime::cameraTrouble(camera_ ? &*camera_ : nullptr, now_ns_);
  if (!words.empty()) return words;
  const auto displaced = runtime::displacedBoard(*camera_, stage_.places, displaced_);
  displaced_ = displaced ? std::optional(displaced->board) : std::nullopt;
  return displaced ? displaced->words : "";
}

void TrialScene::composeAll() {
  const std::string camera = trouble();
  state_.registered = registered_;
  state_.X_CA = X_CW_ * stage_.X_WA;
  state_.X_AT = X_AD_ * unpack(tool_.X_DT);
  compose(state_, tool_, camera.empty() && stage_.head ? stage_.head->trouble() : camera);
  showEllipse(camera.empty());
  hideBehindRealThings();
  state_.help = help_ ? stage_.keys : std::vector<scene::KeyHelp>();
  if (stage_.more) stage_.more(state_);
  keepShown(stage_.shown, &state_);
}

void TrialScene::showEllipse(bool camera_good) {
  state_.tip_covariance_A = stage_.tip_covariance_A && stage_.view && camera_good
                                ? stage_.tip_covariance_A(unpack(tool_.X_DT))
                                : std::nullopt;
  state_.hud.overlay = state_.tip_covariance_A ? overlayText(*state_.tip_covariance_A) : "";
}

/// Those on a board that is not seen hide nothing.
void TrialScene::hideBehindRealThings() {
  state_.occluders.clear();
  for (const PlacedThing& thing : stage_.things) {
    const station::RealThing& place = *thing.place;
    if (place.on == station::RealThing::On::table) {
      state_.occluders.push_back({thing.mesh, stage_.X_WA.inverse() * place.X});
    } else if (place.on == station::RealThing::On::tool) {
      state_.occluders.push_back({thing.mesh, state_.X_AT * place.X});
    } else {
      const bool seen =
          camera_ && place.board < camera_->others.size() && camera_->others[place.board];
      state_.occluders.push_back(
          {seen ? thing.mesh : nullptr,
           seen ? state_.X_CA.inverse() * *camera_->others[place.board] * place.X
                : Pose::Identity()});
    }
  }
}

void TrialScene::informOperator(std::int64_t now_ns) {
  runtime::Displayed displayed;
  displayed.t_ns = now_ns;
  displayed.X_AT = state_.X_AT;
  displayed.trial = status_->trial;
  displayed.running = status_->state == TrialState::running;
  addTo(displayed, tool_);
  bus_.scene_to_operator.publish(displayed, now_ns + stage_.display_latency_ns);
}

/// In the picture without distortion, a hand's length around; nowhere: all of it.
cv::Rect TrialScene::placeOfBoard() const {
  constexpr double kAround = 0.12;
  const Vec3 middle = X_CW_.translation();
  if (!registered_ || middle.z() < kAround) return {};
  const scene::Pinhole& p = state_.camera;
  const double u = p.fx * middle.x() / middle.z() + p.cx, v = p.fy * middle.y() / middle.z() + p.cy;
  const double half = p.fx * kAround / middle.z();
  return {int(u - half), int(v - half), int(2 * half), int(2 * half)};
}

void TrialScene::render() {
  if (fresh_picture_ && camera_ && camera_->picture) {
    const cv::Mat straight = undistorter_.apply(*camera_->picture);
    background_ = toImage(straight);
    look_.see(straight, placeOfBoard(), now_ns_);
    state_.look = look_.look();
    fresh_picture_ = false;
  }
  state_.picture = background_.pixels.empty() ? nullptr : &background_;
  stage_.view->show(state_);
}

void TrialScene::keepPictures() {
  PictureRequest moment;
  while (channels_.pictures_to_scene.pop(&moment)) {
    follow(now_ns_);  // what was asked for after this frame was composed
    composeAll();
    save(pictureFile(moment), moment);
  }
  if (!stage_.every_source_picture || !camera_ || !fresh_picture_) return;
  const std::string source = std::filesystem::path(camera_->source).stem().string();
  if (std::find(kept_sources_.begin(), kept_sources_.end(), source) != kept_sources_.end()) return;
  kept_sources_.push_back(source);
  save("view-" + source + ".png",
       {status_->trial, status_->elapsed_s, source,
        camera_->pose ? "Registered on " + source : "No board found in " + source});
}

/// Evidence: without what was said to whoever sits before the window.
void TrialScene::save(const std::string& name, const PictureRequest& moment) {
  state_.help.clear();
  state_.hud.can_do.clear();
  render();
  const std::filesystem::path file = stage_.folder / name;
  writer_.write(file, stage_.view->capture());
  pictures_.push_back({file, moment});
}

}  // namespace palpa::trial
