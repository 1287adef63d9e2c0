#include "apps/session/session_options.h"

#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <tuple>

#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "apps/station/assets.h"
#include "apps/station/station_file.h"
#include "ar/cameras/recorded_pictures.h"
#include "scene/window/x11_window.h"

namespace palpa::session {
namespace {

void checkPerson(const SessionOptions& o) {
  if (o.fast)
    throw UsageError("cannot go with --operator person", "--fast", "A person needs real time");
  if (o.no_views || (o.display != scene::Display::window && !o.headset))
    throw UsageError("needs a window", "--operator person",
                     "Set DISPLAY, or choose --operator expert or novice on the virtual bench");
}

/// What the presentation would hide is refused: it would be taken for shown.
void checkShown(const SessionOptions& o) {
  const presentation::Presentation shown = shownIn(o);
  const std::tuple<const char*, bool, bool> asked[]{
      {"--guide on", o.guide, shown.guidance},
      {"--guidance on", o.guidance, shown.guidance},
      {"--see-through on", o.see_through, shown.anatomy},
      {"--skin-deflection on", o.skin_deflection, shown.skin_deflection}};
  for (const auto& [option, wanted, may] : asked)
    if (wanted && !may)
      throw UsageError("is not shown in the presentation \"" + shown.name + "\"", option,
                       "Leave it out, or choose --presentation practice");
}

/// What was asked for is refused; what is on by default is taken away, with a word.
void settleAssessment(SessionOptions& o) {
  const std::pair<const char*, bool> aids[]{
      {"--guide on", o.guide},
      {"--guidance on", o.guidance},
      {"--see-through on", o.see_through},
      {"--augment on", o.augment},
      {"--skin-deflection on", o.skin_deflection},
      {"--mode augmented", o.mode == "augmented" || o.mode == "all"},
      {"--blocks", o.blocks}};
  for (const auto& [option, given] : aids)
    if (given)
      throw UsageError("is an aid or practice, and in an assessment every aid is off",
                       std::string(option) + " with --assess", "Leave one of them out");
  o.role = training::Role::assessed;
  o.demonstration = false;
  if (const presentation::Presentation shown = shownIn(o); !presentation::unaided(shown))
    throw UsageError(
        "shows what is not there without a simulator (" + presentation::describe(shown) + ")",
        "--presentation with --assess", "Choose assessed or pilot");
  if (!o.quiet)
    std::puts(
        "Assessment: every aid is off: the view stays fixed, the skin is solid, the screen shows "
        "neither anatomy nor tissue nor force, no demonstration");
}

/// Nobody is filmed unasked.
void checkFilm(const SessionOptions& o) {
  if (o.film_room.empty()) return;
  if (!o.film_agreed)
    throw UsageError("films people, and nobody has said that they agree", "--film-room",
                     "Ask who trains; who agrees is filmed with --film-agreed beside it");
  if (!std::filesystem::exists(o.film_room))
    throw UsageError("is not there", "--film-room " + o.film_room, "Plug it in, or leave it out");
  if (o.fast && !ar::isVideoFile(o.film_room))
    throw UsageError("needs real time", "--film-room with a camera", "Leave out --fast");
}

/// The model takes the place of pictures that nobody sees.
void checkTracking(const SessionOptions& o) {
  if (o.tracking == Tracking::images) return;
  constexpr const char* kOption = "--tracking model";
  if (!o.fast || !o.no_views)
    throw UsageError("draws no pictures, so it goes with --fast and --no-views only", kOption,
                     "Add both, or leave it out");
  if (!o.camera.empty())
    throw UsageError("takes the place of pictures, so it cannot go with --camera", kOption,
                     "Leave one of them out");
  if (o.record_video)
    throw UsageError("draws no pictures that could be kept", "--record-video with --tracking model",
                     "Leave one of them out");
}

}  // namespace

const char* nameOf(OperatorKind who) {
  switch (who) {
    case OperatorKind::person:
      return "person";
    case OperatorKind::recorded:
      return "recorded";
    case OperatorKind::novice:
      return "novice";
    case OperatorKind::custom:
      return "custom";
    case OperatorKind::learner:
      return "learner";
    default:
      return "expert";
  }
}

std::filesystem::path operatorFile(const SessionOptions& options, const std::string& engine) {
  if (options.who == OperatorKind::custom) return options.operator_file;
  const char* skilled = options.who == OperatorKind::novice ? "novice" : "expert";
  return station::assetFile("operators/" + engine + skilled + ".json");
}

presentation::Presentation shownIn(const SessionOptions& options) {
  if (options.presentation) return *options.presentation;
  const auto shipped = [](const char* name) {
    return presentation::readPresentation(station::assetFile("presentations") /
                                          (std::string(name) + ".json"));
  };
  if (training::inAssessment(options.role)) return shipped("assessed");
  const presentation::Presentation practice = shipped("practice");
  const bool told = options.force_feedback && !options.hide_forces;
  return told ? practice : presentation::withoutForces(practice);
}

namespace {

std::string simulationMark(OperatorKind who, const station::Station& station) {
  if (isSimulated(who)) return "SIMULATED OPERATOR";
  if (who == OperatorKind::recorded) return "RECORDED HAND";
  if (!station.simulated) return "";
  return station.device.driver == station::DeviceDriver::bench ? "VIRTUAL BENCH" : "VIRTUAL CAMERA";
}

}  // namespace

std::string markFor(const SessionOptions& options, const station::Station& station) {
  std::string mark = simulationMark(options.who, station);
  if (!options.film_room.empty()) mark += mark.empty() ? "FILMED" : ", FILMED";
  return mark;
}

bool mayHear(const SessionOptions& o) {
  const bool seen = o.display == scene::Display::window || o.headset;
  return o.sound && !o.fast && !o.no_views && seen;
}

std::string sessionText(nlohmann::json session, const SessionOptions& options) {
  session["presentation"] = presentation::jsonOf(shownIn(options));
  if (options.who == OperatorKind::custom)
    session["operator_file"] = JsonFile(options.operator_file).json();
  const StudyStep& s = options.study;
  if (!s.id.empty())
    session["study"] = {{"id", s.id},
                        {"slot", s.slot},
                        {"group", s.group},
                        {"condition", s.condition},
                        {"block", s.block},
                        {"step", s.step},
                        {"protocol_sha256", s.protocol_sha256}};
  // the name of a file may be no text
  return session.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void settleOperator(SessionOptions& o, const station::Station& station) {
  const station::DeviceDriver driver = station.device.driver;
  const std::string where = station.file.name() + ", device/driver";
  if (driver == station::DeviceDriver::replay) {
    if (o.who != OperatorKind::automatic)
      throw UsageError("is \"replay\": the recorded hand performs", where, "Leave out --operator");
    o.who = OperatorKind::recorded;
    return;
  }
  if (driver != station::DeviceDriver::bench && isSimulated(o.who))
    throw UsageError("is a real device, which a simulated operator cannot hold", where,
                     "Leave out --operator, or use the virtual bench");
  if (o.who == OperatorKind::automatic) {
    const bool person =
        driver != station::DeviceDriver::bench || o.display == scene::Display::window || o.headset;
    o.who = person ? OperatorKind::person : OperatorKind::expert;
  }
  if (o.knows_patient && !isSimulated(o.who))
    throw UsageError("is for a simulated operator", "--operator-knows",
                     "Add --operator expert or novice, or leave it out");
  if (o.who == OperatorKind::person) checkPerson(o);
  if (o.display != scene::Display::window) o.demonstration = false;  // it is shown in a window
}

void settle(SessionOptions& o) {
  if (o.display == scene::Display::automatic) {
    const bool shown = !o.fast && !o.no_views;
    if (shown && !o.headset && scene::isWaylandAlone())
      throw UsageError(scene::whyNoX11(), "the window", scene::adviceWithoutX11());
    o.display =
        shown && std::getenv("DISPLAY") ? scene::Display::window : scene::Display::offscreen;
  }
  if (o.who == OperatorKind::person) checkPerson(o);
  if (o.headset && (o.fast || o.no_views))
    throw UsageError("cannot go with --display openxr", o.fast ? "--fast" : "--no-views",
                     "Leave one of them out: a headset shows what happens now");
  if (o.assess) settleAssessment(o);
  checkShown(o);
  checkTracking(o);
  checkFilm(o);
  if (o.exact_geometry && !o.fast)
    throw UsageError("needs virtual time", "--geometry exact",
                     "Add --fast: the full mesh takes longer than a tick");
  if (o.display == scene::Display::window && o.fast)
    throw UsageError("cannot go with --display window", "--fast", "Leave one of them out");
  if (!o.camera.empty() && (o.intrinsics.empty() || o.board.empty()))
    throw UsageError("needs --intrinsics and --board", "--camera",
                     "Say which camera took the pictures and which board they show");
  if (o.camera.empty() && (!o.intrinsics.empty() || !o.board.empty()))
    throw UsageError("go with --camera only", "--intrinsics, --board",
                     "The station's camera has its own");
}

}  // namespace palpa::session
