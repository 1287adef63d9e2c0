#include "ar/headset/xr_frames.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "ar/headset/xr_call.h"

namespace palpa::ar {
namespace {

constexpr XrViewStateFlags kTurned = XR_VIEW_STATE_ORIENTATION_VALID_BIT,
                           kPlaced = XR_VIEW_STATE_POSITION_VALID_BIT;
constexpr double kHalfApart = 0.0315;  // m, half the mean distance of adults' eyes (Dodgson 2004)
constexpr int kPollsAtEnd = 30;

XrOwnedSpace localSpace(XrSession session) {
  const XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr,
                                        XR_REFERENCE_SPACE_TYPE_LOCAL, identityXr()};
  XrSpace space = XR_NULL_HANDLE;
  xrCheck(xrCreateReferenceSpace(session, &info, &space), "xrCreateReferenceSpace");
  return XrOwnedSpace(space);
}

}  // namespace

XrFrames::XrFrames(const GlBinding& gl)
    : runtime_(openRuntime(gl.kind)),
      session_(makeSession(runtime_.instance.get(), runtime_.system, gl)) {
  const std::int64_t format = formatFor(session_.get(), blend());
  for (std::size_t i = 0; i < 2; ++i) {
    pictures_[i].emplace(session_.get(), runtime_.views[i], format);
    frame_.eyes[i].width = pictures_[i]->width();
    frame_.eyes[i].height = pictures_[i]->height();
  }
  local_ = localSpace(session_.get());
  controls_.emplace(runtime_.instance.get(), session_.get());
}

/// A runtime that fails in use ends the headset, not the program.
template <class Do>
void XrFrames::guarded(Do act) {
  try {
    if (state_ != HeadsetState::lost) act();
  } catch (const XrFailure& failure) {
    lose(inWords(failure).what);
  } catch (const std::exception& failure) {
    lose(failure.what());
  }
}

void XrFrames::lose(const std::string& why) {
  state_ = HeadsetState::lost;
  trouble_ = why;
  begun_ = false;
}

bool XrFrames::canDraw() const { return pictures_[0]->taken() && pictures_[1]->taken(); }

void XrFrames::next() {
  guarded([this] {
    if (begun_) end(false);
    followEvents();
    if (state_ != HeadsetState::running) return;
    begin();
    locateEyes();
    readControls();
    frame_.draw = should_draw_;
    if (should_draw_ && ever_located_)
      for (std::optional<XrEye>& eye : pictures_) eye->take();
  });
}

void XrFrames::begin() {
  XrFrameState timing{XR_TYPE_FRAME_STATE, nullptr, 0, 0, XR_FALSE};
  xrCheck(xrWaitFrame(session_.get(), nullptr, &timing), "xrWaitFrame");
  xrCheck(xrBeginFrame(session_.get(), nullptr), "xrBeginFrame");
  begun_ = true;
  time_ = timing.predictedDisplayTime;
  should_draw_ = timing.shouldRender == XR_TRUE;
}

void XrFrames::show(bool drawn) {
  guarded([&] { end(drawn); });
}

void XrFrames::end(bool drawn) {
  const bool shown = drawn && canDraw();
  std::array<XrCompositionLayerProjectionView, 2> seen;
  for (std::size_t i = 0; i < 2; ++i) {
    pictures_[i]->giveBack();
    seen[i] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW, nullptr, views_[i].pose, views_[i].fov,
               pictures_[i]->shown()};
  }
  const XrCompositionLayerFlags alpha = runtime_.blend == XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND
                                            ? XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT
                                            : 0;
  const XrCompositionLayerProjection layer{
      XR_TYPE_COMPOSITION_LAYER_PROJECTION, nullptr, alpha, local_.get(), 2, seen.data()};
  const auto* const layers = reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer);
  const XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO, nullptr,         time_,
                            runtime_.blend,         shown ? 1u : 0u, shown ? &layers : nullptr};
  begun_ = false;
  xrCheck(xrEndFrame(session_.get(), &info), "xrEndFrame");
}

void XrFrames::readControls() {
  const ButtonPresses asked = controls_->read(session_.get(), local_.get(), time_, &frame_.hands);
  const bool moved = moves_at_ && *moves_at_ <= time_;
  if (moved) moves_at_.reset();
  frame_.recentred = moved || first_place_ || asked.recentre;
  frame_.start = asked.start;
}

void XrFrames::vibrate(std::size_t hand, double seconds, double strength) {
  guarded([&] {
    if (state_ == HeadsetState::running)
      controls_->vibrate(session_.get(), hand, seconds, strength);
  });
}

void XrFrames::followEvents() {
  XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER, nullptr, {}};
  while (state_ != HeadsetState::lost &&
         xrCheck(xrPollEvent(runtime_.instance.get(), &event), "xrPollEvent") == XR_SUCCESS) {
    const auto* const base = reinterpret_cast<const XrEventDataBaseHeader*>(&event);
    if (base->type == XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING)
      lose("the headset's runtime is being closed");
    if (base->type == XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING)
      follow(*reinterpret_cast<const XrEventDataReferenceSpaceChangePending*>(&event));
    if (base->type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED)
      follow(reinterpret_cast<const XrEventDataSessionStateChanged*>(&event)->state);
    event = {XR_TYPE_EVENT_DATA_BUFFER, nullptr, {}};
  }
}

void XrFrames::follow(const XrEventDataReferenceSpaceChangePending& change) {
  if (change.referenceSpaceType == XR_REFERENCE_SPACE_TYPE_LOCAL)
    moves_at_ = std::min(moves_at_.value_or(change.changeTime), change.changeTime);
}

void XrFrames::follow(XrSessionState next) {
  switch (next) {
    case XR_SESSION_STATE_READY: {
      const XrSessionBeginInfo info{XR_TYPE_SESSION_BEGIN_INFO, nullptr, kTwoEyes};
      xrCheck(xrBeginSession(session_.get(), &info), "xrBeginSession");
      state_ = HeadsetState::running;
      break;
    }
    case XR_SESSION_STATE_STOPPING:
      state_ = HeadsetState::waiting;
      xrCheck(xrEndSession(session_.get()), "xrEndSession");
      break;
    case XR_SESSION_STATE_EXITING:
      return lose("the headset's session was ended there");
    case XR_SESSION_STATE_LOSS_PENDING:
      return lose("the headset was lost");
    default:
      break;
  }
}

void XrFrames::locateEyes() {
  const XrViewLocateInfo info{XR_TYPE_VIEW_LOCATE_INFO, nullptr, kTwoEyes, time_, local_.get()};
  XrViewState flags{XR_TYPE_VIEW_STATE, nullptr, 0};
  std::uint32_t count = 0;
  std::array<XrView, 2> views;
  views.fill({XR_TYPE_VIEW, nullptr, identityXr(), {}});
  xrCheck(xrLocateViews(session_.get(), &info, &flags, 2, &count, views.data()), "xrLocateViews");
  frame_.head_known = (flags.viewStateFlags & kTurned) != 0 && count == 2;
  if (!frame_.head_known) return;
  const bool placed = (flags.viewStateFlags & kPlaced) != 0;
  if (!placed) stayInPlace(&views);
  first_place_ = placed && !std::exchange(ever_placed_, placed || ever_placed_);
  ever_located_ = true;
  keepEyes(views);
}

void XrFrames::keepEyes(const std::array<XrView, 2>& views) {
  views_ = views;
  for (std::size_t i = 0; i < 2; ++i) {
    EyeView& eye = frame_.eyes[i];
    eye.left = std::tan(views[i].fov.angleLeft);
    eye.right = std::tan(views[i].fov.angleRight);
    eye.up = std::tan(views[i].fov.angleUp);
    eye.down = std::tan(views[i].fov.angleDown);
    eye.X_LE = poseFromXr(views[i].pose);
  }
}

/// Where a runtime knows how the head is turned but not where it is: it stays where it was, and
/// the eyes turn about its middle.
void XrFrames::stayInPlace(std::array<XrView, 2>* views) const {
  const Pose before[] = {poseFromXr(views_[0].pose), poseFromXr(views_[1].pose)};
  const Vec3 middle = ever_located_
                          ? Vec3(0.5 * (before[0].translation() + before[1].translation()))
                          : Vec3(Vec3::Zero());
  const double half =
      ever_located_ ? 0.5 * (before[1].translation() - before[0].translation()).norm() : kHalfApart;
  for (std::size_t i = 0; i < 2; ++i) {
    (*views)[i].pose.position = {0, 0, 0};
    const Vec3 p =
        middle + poseFromXr((*views)[i].pose).linear() * Vec3(i == 0 ? -half : half, 0, 0);
    (*views)[i].pose.position = positionToXr(p);
  }
}

/// A session must be ended before it goes: asked to stop, told that it stops, ended. A runtime may
/// wait for frames before it stops.
void XrFrames::finish() {
  guarded([this] {
    if (begun_) end(false);
    if (state_ != HeadsetState::running) return;
    xrCheck(xrRequestExitSession(session_.get()), "xrRequestExitSession");
    for (int i = 0; i < kPollsAtEnd; ++i) {
      followEvents();
      if (state_ != HeadsetState::running) return;
      begin();
      end(false);
    }
  });
}

}  // namespace palpa::ar
