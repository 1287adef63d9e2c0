#include "apps/session/session_facts.h"
#include "apps/session/session_records.h"
#include "apps/session/stage.h"

#include <cstdarg>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/sha256.h"
#include "apps/assess/dose_counter.h"
#include "apps/evidence/recorded_trials.h"
#include "apps/evidence/told_events.h"
#include "apps/report/page/style.h"
#include "apps/runtime/clock.h"
#include "apps/station/taken_away.h"
#include "apps/twin/tracking_model.h"
#include "scene/window/gl_context.h"

namespace palpa::session {
namespace {

/// Every trip with its cause: how often, and when first.
std::vector<report::Fact> safetyFacts(const std::vector<runtime::Event>& events) {
  std::vector<report::Fact> facts;
  std::map<std::string, std::pair<int, const runtime::Event*>> by_text;
  for (const runtime::Event& event : events) {
    auto& [count, first] = by_text[event.text];
    if (++count == 1) first = &event;
  }
  for (const auto& [text, times] : by_text) {
    const auto& [count, first] = times;
    facts.push_back(
        {text, howOften(count),
         format("first %.1f s after the session's start", 1e-9 * static_cast<double>(first->t_ns)) +
             (first->trial > 0 ? format(", in trial %d", first->trial) : "")});
  }
  return facts;
}

}  // namespace

std::string format(const char* pattern, ...) {
  char text[256];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  return text;
}

std::string whoPerformed(const SessionOptions& options) {
  if (options.who == OperatorKind::person) return options.trainee;
  if (options.who == OperatorKind::recorded) return "recorded hand";
  if (options.who == OperatorKind::learner) return options.trainee + ", a simulated learner";
  const std::string who = options.who == OperatorKind::custom
                              ? "simulated operator of " +
                                    std::filesystem::path(options.operator_file).filename().string()
                              : std::string("simulated ") + nameOf(options.who);
  return options.knows_patient ? who + " who has studied this patient" : who;
}

std::vector<report::Fact> lumpFacts(const station::LumpLibrary& library) {
  std::vector<report::Fact> facts;
  for (const station::LumpKind& kind : library.kinds)
    facts.push_back({"Lump \"" + kind.name + "\"",
                     format("%.0f mm across, %.0f mm deep, %s", 1e3 * kind.diameter,
                            1e3 * kind.depth, kind.hardness == 1 ? "soft" : "hard"),
                     format("changes the force by %.0f %% where it is felt%s", 100 * kind.contrast,
                            library.simulated ? "; identified in simulated silicone" : "")});
  return facts;
}

report::Fact surfaceFact(const station::LumpLibrary& library) {
  return {"Softness and friction of the sample", library.of_surface, ""};
}

std::vector<report::Fact> steadyingFacts(const SessionOptions& options,
                                         const station::NamedPlan& plan,
                                         const station::Station& station) {
  std::vector<report::Fact> facts;
  if (!options.augment) return facts;
  for (const station::SteadyingFigures& one : station::steadyingsOf(plan, station, options.rate_Hz))
    facts.push_back({"Taken off the hand: " + one.name, station::inWords(one), ""});
  return facts;
}

void sayTaken(const SessionOptions& options, const std::vector<report::Fact>& facts) {
  if (options.quiet) return;
  for (const report::Fact& fact : facts)
    std::printf("%s: %s\n", fact.name.c_str(), fact.value.c_str());
  std::fflush(stdout);
}

std::vector<report::Fact> fingerFacts(const SessionOptions& options) {
  if (options.tools < 2) return {};
  std::vector<report::Fact> facts{
      {"Tools", "two fingers side by side", "each lump is solved under both; each is judged"}};
  if (options.tracked_finger)
    facts.push_back({"Second finger's force", "estimated",
                     "it is tracked and has no force sensor: told from the first finger's "
                     "reaction, both places and the silicone's law; it is given no force"});
  return facts;
}

report::Courses<assess::PalpationSample> palpationCourses(const std::filesystem::path& evidence) {
  return [evidence](const auto& draw) {
    evidence::eachPalpation(
        record::SessionReader(evidence),
        [&](const record::RecordedTrial& trial, const task_palpation::PalpationListener& felt) {
          draw(trial.header.trial, felt.samples());
        });
  };
}

std::vector<report::Fact> runNotes(const SessionRun& result) {
  std::vector<report::Fact> facts = drawingFacts(result.renderer, result.lateness);
  for (const runtime::Lateness& late : result.lateness)
    if (late.name == "haptic")
      facts.push_back({"Lateness of the haptic loop",
                       format("median %.0f us, 99 %% below %.0f us, 99.9 %% below %.0f us; %llu of "
                              "%llu ticks missed; a step costs %.1f us",
                              late.median_us, late.p99_us, late.p999_us,
                              static_cast<unsigned long long>(late.missed_ticks),
                              static_cast<unsigned long long>(late.steps), late.cost.median_us),
                       late.scheduling});
  for (report::Fact& fact : safetyFacts(result.safety_events)) facts.push_back(std::move(fact));
  facts.insert(facts.end(), result.devices.begin(), result.devices.end());
  for (const std::string& remark : result.camera_remarks)
    facts.push_back({"Camera", remark, "the overlay may shift under a calibration"});
  if (result.video && !result.video->trouble.empty())
    facts.push_back({"Video", result.video->trouble,
                     format("%llu pictures were kept",
                            static_cast<unsigned long long>(result.video->pictures))});
  if (result.dropped)
    facts.push_back({"Records lost",
                     format("%llu", static_cast<unsigned long long>(result.dropped)),
                     "the computer could not keep up: the replay is not exact there"});
  return facts;
}

report::SubtaskMeanings meaningsOf(const station::NamedPlan& plan) {
  report::SubtaskMeanings meanings;
  for (const station::NamedPart& part : plan.subtasks) meanings.emplace_back(part.name, part.means);
  return meanings;
}

std::vector<assess::SubtaskDose> noDoses(const haptics::AugmentationPlan& on_device,
                                         const station::NamedPlan& plan) {
  assess::TrialDoses doses(on_device, plan.subtaskNames());
  doses.begin(1);
  return doses.doses();
}

namespace {

using nlohmann::json;

json jsonOf(const std::vector<report::Fact>& facts) {
  json all = json::array();
  for (const report::Fact& fact : facts) all.push_back({fact.name, fact.value, fact.remark});
  return all;
}

std::vector<report::Fact> factsIn(const json& list) {
  std::vector<report::Fact> facts;
  for (const json& fact : list) facts.push_back({fact.at(0), fact.at(1), fact.at(2)});
  return facts;
}

/// What evidence without a "report" tells of its session.
void headOfOld(const record::SessionInfo& info, const json& session, ReportHead* head) {
  const json task = parseJson(info.task_json), station = parseJson(info.station_json);
  const std::string who = session.value("operator", "");
  head->title = task.value("title", info.command);
  head->trainee = who == "person"     ? head->user_id
                  : who == "recorded" ? "recorded hand"
                                      : "simulated " + who;
  head->station = {{"Station", station.value("title", ""), station.value("id", "")},
                   {"Software", info.software, ""},
                   {"Parts of the task, settings of the station", "not told",
                    "the evidence was made by a version that did not record them for the report"}};
}

void headOfNew(const json& report, ReportHead* head) {
  head->title = report.at("title");
  head->trainee = report.at("trainee");
  head->force_note = report.at("force_note");
  head->unit_note = report.at("unit_note");
  head->too_hard_N = report.at("too_hard_N");
  head->taxonomy = factsIn(report.at("taxonomy"));
  head->station = factsIn(report.at("station"));
  for (const json& part : report.at("parts")) head->parts.emplace_back(part.at(0), part.at(1));
  for (const json& part : report.at("columns")) {
    head->doses.emplace_back();
    head->doses.back().subtask = part;
  }
}

}  // namespace

json jsonOf(const ReportHead& head) {
  json parts = json::array();
  for (const auto& [name, means] : head.parts) parts.push_back({name, means});
  json columns = json::array();
  for (const assess::SubtaskDose& dose : head.doses) columns.push_back(dose.subtask);
  return {{"title", head.title},
          {"trainee", head.trainee},
          {"force_note", head.force_note},
          {"unit_note", head.unit_note},
          {"too_hard_N", head.too_hard_N},
          {"taxonomy", jsonOf(head.taxonomy)},
          {"station", jsonOf(head.station)},
          {"parts", parts},
          {"columns", columns}};
}

namespace {

/// Where the task stands, as its file says.
std::vector<report::Fact> taxonomyFacts(const station::Taxonomy& taxonomy, bool on_bench) {
  if (taxonomy.visual.empty()) return {};
  std::vector<report::Fact> facts{{"What is seen", taxonomy.visual, ""},
                                  {"What is felt", taxonomy.haptic, ""},
                                  {"What it is for", taxonomy.purpose, ""},
                                  {"What is changed", taxonomy.property, ""}};
  if (on_bench)
    facts.push_back({"Here", "simulated",
                     "at least a part of what is called real is a model on the virtual bench"});
  return facts;
}

/// Station, device, calibration, time, software: in this order.
std::vector<report::Fact> stationFactsOf(const SessionOptions& options,
                                         const station::Station& station) {
  std::vector<report::Fact> facts{
      {"Station", station.title, station.id},
      {"Haptic device", station.device.capabilities.name,
       format("%.1f N, stable to %.0f N/m", station.device.capabilities.max_force_N,
              station.device.capabilities.stable_stiffness)},
      {"Calibration", station.calibration_verdict, station.calibration_date},
      {"On the screen", shownIn(options).name, presentation::describe(shownIn(options))},
      {"Time", options.fast ? "virtual (repeats exactly)" : "real", ""},
      {"Software", std::string("palpa ") + PALPA_VERSION, ""}};
  if (options.display == scene::Display::window || options.headset)
    facts.push_back({"Sound", mayHear(options) ? "on" : "off", ""});
  if (options.tracking == Tracking::model)
    facts.push_back(
        {"Board", "tracked by a model",
         "of the errors that pictures would have caused; no picture was drawn. Figures " +
             sha256OfFile(twin::trackingFigureFile(station)).substr(0, 12)});
  if (!options.study.id.empty())
    facts.push_back({"Study", options.study.id,
                     "block " + options.study.block});  // not the condition: it may be blind
  return facts;
}
}  // namespace

ReportHead headOf(const SessionOptions& options, const std::string& title,
                  const station::Taxonomy& taxonomy, const station::Station& station,
                  bool simulated) {
  ReportHead head;
  head.title = title;
  head.trainee = whoPerformed(options);
  head.user_id = options.trainee;
  head.simulated = simulated;
  head.assessed = options.assess;
  head.page = options.report;
  head.taxonomy = taxonomyFacts(taxonomy, station.simulated);
  head.station = stationFactsOf(options, station);
  return head;
}

record::SessionInfo infoOf(const SessionOptions& options, const ReportHead& head,
                           const std::string& task_json, json of_task) {
  record::SessionInfo info;
  info.uuid = options.uuid;
  info.started_utc = runtime::utcNow();
  info.software = std::string("palpa ") + PALPA_VERSION;
  info.command = options.command;
  of_task.update({{"seed", options.seed},
                  {"bench_seed", options.benchSeed()},
                  {"operator", nameOf(options.who)},
                  {"simulated", head.simulated},
                  {"trainee", options.trainee},
                  {"force_feedback", options.force_feedback},
                  {"virtual_time", options.fast},
                  {"tracking", options.tracking == Tracking::model ? "model" : "images"},
                  {"assessed", options.assess},
                  {"task", parseJson(task_json).value("id", "")},
                  {"sound", mayHear(options)},
                  {"filmed", !options.film_room.empty()},
                  {"report", jsonOf(head)}});
  for (const progress::Group& group : options.others)
    of_task["report"]["others"].push_back(jsonOf(group));
  info.task_json = task_json;
  info.session_json = sessionText(std::move(of_task), options);
  return info;
}

ReportHead headIn(const record::SessionInfo& info, const std::string& file) {
  ReportHead head;
  try {
    const json session = parseJson(info.session_json);
    head.user_id = session.value("trainee", "");
    head.simulated = session.value("simulated", false);
    head.assessed = session.value("assessed", false);
    if (session.contains("report"))
      headOfNew(session["report"], &head);
    else
      headOfOld(info, session, &head);
  } catch (const json::exception& e) {
    throw Error("the session's description is damaged (" + whyNoJson(info.session_json, e) + ")",
                file, "Restore the file from a backup");
  }
  return head;
}

report::SessionPage pageOf(const ReportHead& head, const ReportTail& tail,
                           const std::filesystem::path& evidence, training::Engine engine,
                           const std::vector<progress::JudgedTrial>& trials) {
  const record::SessionReader session(evidence);
  report::SessionPage page = evidence::whatWasNoted(session);
  page.title = head.title;
  page.trainee = head.trainee;
  page.simulated = head.simulated;
  page.taxonomy = head.taxonomy;
  page.station = head.station;
  page.notes = tail.notes;
  page.next = progress::practiseNext(engine, trials);
  page.engine = engine;
  page.judged = trials;
  page.others = othersBeside(session.info());
  return page;
}

std::vector<report::Picture> picturesOf(const ReportTail& tail) {
  std::vector<report::Picture> pictures;
  for (const trial::SavedPicture& p : tail.pictures)
    pictures.push_back({p.file, p.moment.caption, p.moment.t_s});
  return pictures;
}

}  // namespace palpa::session
