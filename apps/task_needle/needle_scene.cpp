#include "apps/task_needle/needle_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "anatomy/base/pinned_math.h"
#include "apps/training/trial_words.h"
#include "apps/trial/trial_scene.h"

namespace palpa::task_needle {
namespace {

template <class... Numbers>
std::string format(const char* pattern, Numbers... numbers) {
  char text[96];
  std::snprintf(text, sizeof text, pattern, numbers...);
  return text;
}

std::string depthText(const runtime::ToolState& tool, const TaskWords& words) {
  const std::string surface = "the " + words.of(Organ::skin);
  switch (tool.phase) {
    case haptics::NeedlePhase::outside:
      return "outside " + surface;
    case haptics::NeedlePhase::indenting:
      return "on " + surface;
    case haptics::NeedlePhase::inserted:
      break;
  }
  // The length of needle that is inside: on an oblique way more than the depth under the surface.
  const std::string inserted = format("%.0f mm inserted, ", tool.depth * 1e3);
  if (tool.tissue == Tissue::bone) return inserted + "at " + words.of(tool.tissue);
  return inserted + "in " +
         (tool.tissue == Tissue::vein_lumen ? "the vein" : words.of(tool.tissue));
}

std::string touchedText(const runtime::ToolState& tool) {
  if (tool.tissue == Tissue::lung || tool.wall == Organ::lung) return "LUNG";
  if (tool.tissue == Tissue::artery_lumen || tool.wall == Organ::artery) return "ARTERY";
  if (tool.bone == Organ::clavicle) return "clavicle";
  if (tool.bone != Organ::none) return name(tool.bone);
  if (tool.wall == Organ::vein || tool.tissue == Tissue::vein_lumen) return "subclavian vein";
  return "";
}

}  // namespace

namespace {

std::string questionText(double within_s) {
  const std::string question = "What did you draw? 1: vein, 2: artery, 3: neither";
  return within_s > 0 ? question + format(" (%.0f s left)", std::ceil(within_s)) : question;
}

}  // namespace

bool injury(const runtime::ToolState& tool) {
  return tool.tissue == Tissue::lung || tool.wall == Organ::lung ||
         tool.tissue == Tissue::artery_lumen || tool.wall == Organ::artery;
}

scene::Hud hudText(const TaskStatus& status, const runtime::ToolState& tool,
                   const std::string& camera, const std::string& mark, const TaskWords& words,
                   const presentation::Presentation& shown) {
  scene::Hud hud;
  const bool active = status.active();
  trial::tellTrial(status, shown.guidance ? status.step : "",
                   format("%.1f N", unpack(tool.f_contact_D).norm()), &hud);
  if (active) {
    hud.depth = depthText(tool, words);
    hud.touched = touchedText(tool);
  }
  const bool hurts = active && shown.contact_words && injury(tool);
  std::string own;
  if (hurts)
    own = "The needle touches the " +
          std::string(tool.tissue == Tissue::lung || tool.wall == Organ::lung ? "lung" : "artery") +
          (shown.guidance ? ": pull it back" : "");
  else if (status.flows == Tissue::lung)
    own = "Bubbles rise in the syringe";
  else if (status.flows != Tissue::air)
    own = "Blood flows into the syringe";
  trial::noticeOf(status, tool.safety, own, camera, &hud);
  hud.alarm = hud.alarm || (hurts && hud.notice == own);
  // An answer decides the trial, and is waited for a few seconds: no other word takes its place.
  if (active && status.asked && !status.emergency_stop) {
    hud.notice = questionText(status.answer_within_s);
    hud.alarm = false;
  }
  hud.mark = mark;
  return hud;
}

namespace {

// [chosen] as the skin's shear in assets/materials/needle.json, N/m: the shaft drags the skin along
// its surface.
constexpr double kStiffness = 300;
constexpr double kMostDragged = 3e-3;  // m: then the shaft slips
constexpr double kRelaxing = 0.15;     // s
constexpr double kGone = 5e-5;         // m: nobody sees less
constexpr double kTouching =
    1e-6;  // m: from here on the way from the skin to the tip has a direction

}  // namespace

anatomy::SkinPush SkinFollower::pushed(const Pose& X_AT) const {
  const Vec3 tip = X_AT.translation();
  const anatomy::SurfacePoint foot = query_.closest(skin_, tip);
  anatomy::SkinPush push{foot.p_A, foot.n_A, 0, X_AT.rotation().col(2)};
  if (foot.distance > -kTouching) return push;
  push.depth = -foot.distance;
  push.n_A = (foot.p_A - tip) / push.depth;  // so that p - depth n is the tip
  return push;
}

double SkinFollower::dragged(const runtime::ToolState& tool, const Vec3& axis_A,
                             const Pose& X_AD) const {
  const double resisting = -(X_AD.rotation() * unpack(tool.f_contact_D)).dot(axis_A);
  const double bone = std::abs(tool.bone_force);  // bears on the tip, not on the skin
  const double left = std::max(std::abs(resisting) - bone, 0.0);
  return std::copysign(std::min(left / kStiffness, kMostDragged), resisting);
}

std::optional<anatomy::SkinPush> SkinFollower::follow(const runtime::ToolState& tool,
                                                      const Pose& X_AD, std::int64_t now_ns) {
  const Pose X_AT = X_AD * unpack(tool.X_DT);
  const double dt = 1e-9 * static_cast<double>(std::max<std::int64_t>(now_ns - last_ns_, 0));
  last_ns_ = now_ns;
  if (tool.phase == haptics::NeedlePhase::indenting) {
    push_ = pushed(X_AT);
    return push_;
  }
  const Vec3 axis = X_AT.rotation().col(2);
  double wanted = 0;
  if (tool.phase == haptics::NeedlePhase::inserted) {
    const anatomy::SurfacePoint entry = query_.closest(skin_, X_AD * unpack(tool.entry_D));
    const double was = push_ ? push_->depth : 0;
    push_ = anatomy::SkinPush{entry.p_A, entry.n_A, was, axis};
    wanted = dragged(tool, axis, X_AD);
  }
  if (!push_) return push_;
  push_->depth = wanted + (push_->depth - wanted) * pinned::exp(-dt / kRelaxing);
  if (tool.phase == haptics::NeedlePhase::outside && std::abs(push_->depth) < kGone) push_.reset();
  return push_;
}

namespace {

constexpr double kBoneFelt = 0.1;  // N
constexpr double kBonePulse = 0.08, kPuncturePulse = 0.03,
                 kPunctureStrength = 0.6;  // s; [chosen] to be told apart
constexpr double kTrailStep = 0.0005;      // m between points of the trail
constexpr std::size_t kTrailLongest = 4000;

}  // namespace

NeedleScene::NeedleScene(const NeedleSceneSetup& setup, runtime::Bus& bus, TaskChannels& channels)
    : TrialScene(setup.stage, bus, channels), setup_(setup), channels_(channels) {
  if (setup.giving_way) skin_.emplace(*setup.giving_way, setup.skin);
}

const trial::TrialStatus& NeedleScene::readStatus(std::int64_t now_ns) {
  if (const TaskStatus* status = channels_.status_to_scene.read(now_ns)) status_ = *status;
  return status_;
}

bool NeedleScene::mayWait(const runtime::ToolState& tool) const {
  return tool.phase == haptics::NeedlePhase::outside;
}

/// Tells the hand what a controller can: a layer punctured, bone.
void NeedleScene::pulse(scene::HeadDisplay& head, const runtime::ToolState& tool) {
  const bool inserted = tool.phase == haptics::NeedlePhase::inserted;
  const bool punctured = inserted && (felt_.phase != haptics::NeedlePhase::inserted ||
                                      (felt_.tissue != tool.tissue && tool.depth > felt_.depth));
  const bool on_bone = tool.bone_force > kBoneFelt && felt_.bone_force <= kBoneFelt;
  felt_ = tool;
  if (!status_.force_feedback) return;  // nothing is felt, in whatever way
  if (on_bone)
    head.pulse(kBonePulse, 1);
  else if (punctured)
    head.pulse(kPuncturePulse, kPunctureStrength);
}

void NeedleScene::compose(scene::SceneState& state, const runtime::ToolState& tool,
                          const std::string& trouble) {
  state.guide = setup_.guide;
  if (skin_) state.skin_push = skin_->follow(tool, X_AD(), now_ns());
  state.plunger = tool.plunger;
  state.blood = status_.blood;
  state.blood_of = status_.holds;
  state.hud = hudText(status_, tool, trouble, mark(), setup_.words, shown());
  showForces(state, tool);
  leaveTrail(state, tool);
}

void NeedleScene::showForces(scene::SceneState& state, const runtime::ToolState& tool) {
  state.forces.clear();
  const Vec3 f_A = X_AD().rotation() * unpack(tool.f_contact_D);
  if (f_A.norm() > 0.05) {
    const Vec3 tip = state.X_AT.translation();
    state.forces.push_back({scene::ForceKind::reaction, tip, f_A});
    const Vec3 felt = X_AD().rotation() * unpack(tool.f_command_D);
    if (felt.norm() > 0.05)
      state.forces.push_back(
          {scene::ForceKind::device, (X_AD() * unpack(tool.X_DT)) * Vec3(0, 0, -0.11), felt});
  }
}

void NeedleScene::leaveTrail(scene::SceneState& state, const runtime::ToolState& tool) {
  if (status_.trial != trail_trial_) {
    trail_trial_ = status_.trial;
    state.trail_A.clear();
  }
  const Vec3 tip = state.X_AT.translation();
  if (status_.state == trial::TrialState::running && tool.phase != haptics::NeedlePhase::outside &&
      state.trail_A.size() < kTrailLongest &&
      (state.trail_A.empty() || (tip - state.trail_A.back()).norm() > kTrailStep))
    state.trail_A.push_back(tip);
}

void NeedleScene::addTo(runtime::Displayed& displayed, const runtime::ToolState& tool) {
  displayed.flows = status_.flows;
  if (status_.asked) displayed.question = runtime::Displayed::Question::aspirated;
  displayed.injury = displayed.running && shown().contact_words && injury(tool);
}

}  // namespace palpa::task_needle
