#pragma once

#include <algorithm>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/assess/progress/errors.h"
#include "apps/record/session_file.h"
#include "apps/report/needle/session_report.h"
#include "apps/report/palpation/palpation_report.h"
#include "apps/runtime/flight_sink.h"
#include "apps/session/session_frame.h"
#include "apps/station/material_files.h"
#include "apps/station/task_sections.h"
#include "apps/training/engine.h"
#include "apps/training/trial_words.h"

/// What a report says of any session besides its trials.
namespace palpa::session {

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern,
                                                 ...);  ///< printf's, up to 255 characters

/// A pseudonym, "simulated expert", "recorded hand".
std::string whoPerformed(const SessionOptions& options);
/// By what the surface that is touched is known.
report::Fact surfaceFact(const station::LumpLibrary& library);
/// Of two fingers: how they press, and of whose force there is no sensor; of one nothing.
std::vector<report::Fact> fingerFacts(const SessionOptions& options);
/// What was felt in each trial, from the evidence.
report::Courses<assess::PalpationSample> palpationCourses(const std::filesystem::path& evidence);
/// Each of its lumps: size, depth, hardness, how much it changes the force.
std::vector<report::Fact> lumpFacts(const station::LumpLibrary& library);
/// What the device takes away of what is real, and what of it is passive; said on standard output
/// before the session starts, too (`sayTaken`).
std::vector<report::Fact> steadyingFacts(const SessionOptions& options,
                                         const station::NamedPlan& plan,
                                         const station::Station& station);
void sayTaken(const SessionOptions& options, const std::vector<report::Fact>& facts);
/// Lateness, trips with their causes, what drivers and camera had to say, records lost.
std::vector<report::Fact> runNotes(const SessionRun& run);

/// What a report says that is known before the first trial. It stands in the evidence, so that the
/// report can be made without the program that held the session.
struct ReportHead {
  std::string title;
  std::string trainee;                ///< who performed, in words
  std::string user_id;                ///< the same in trials.csv: the pseudonym
  bool simulated = false;             ///< operator or bench are
  bool assessed = false;              ///< in an assessment
  bool page = true;                   ///< report.html is made
  std::string force_note, unit_note;  ///< empty: none
  double too_hard_N = 0;              ///< of a comparison
  std::vector<report::Fact> taxonomy, station;
  report::SubtaskMeanings parts = {};  ///< of the task
  /// of each part nothing yet: the columns of a table without a trial
  std::vector<assess::SubtaskDose> doses = {};
};
/// Its beginning, the same for every task.
ReportHead headOf(const SessionOptions& options, const std::string& title,
                  const station::Taxonomy& taxonomy, const station::Station& station,
                  bool simulated);
/// What of it the rest of the evidence does not tell, for the session's text under "report".
nlohmann::json jsonOf(const ReportHead& head);
/// What every task tells the evidence of its session alike; `of_task`: what it tells itself.
record::SessionInfo infoOf(const SessionOptions& options, const ReportHead& head,
                           const std::string& task_json,
                           nlohmann::json of_task = nlohmann::json::object());
/// Read again. Of evidence that was made before it had a "report": what there is. Throws Error for
/// a text that is damaged.
ReportHead headIn(const record::SessionInfo& info, const std::string& file);

/// What a report says besides trials and head, when the session is over.
struct ReportTail {
  std::vector<trial::SavedPicture> pictures;
  std::vector<report::Fact> notes, registration = {};
};
/// A page's beginning and end, with what was noted in the evidence. Throws Error.
report::SessionPage pageOf(const ReportHead& head, const ReportTail& tail,
                           const std::filesystem::path& evidence, training::Engine engine,
                           const std::vector<progress::JudgedTrial>& trials);
/// `of` makes each a JudgedTrial.
template <class Trials, class Of>
std::vector<progress::JudgedTrial> judgedOf(const Trials& trials, const Of& of) {
  std::vector<progress::JudgedTrial> all;
  for (const auto& trial : trials) all.push_back(of(trial));
  return all;
}
std::vector<report::Picture> picturesOf(const ReportTail& tail);

/// Of the parts of a task what they mean.
report::SubtaskMeanings meaningsOf(const station::NamedPlan& plan);
/// What was given in them before the first trial. `on_device`: the plan as the loop runs with it.
std::vector<assess::SubtaskDose> noDoses(const haptics::AugmentationPlan& on_device,
                                         const station::NamedPlan& plan);

/// The parts of a task for its report.
template <typename Trials, typename Of>
report::SubtaskSection partsOf(const report::SubtaskMeanings& meanings, const Trials& trials,
                               Of of) {
  report::SubtaskSection section;
  section.meanings = meanings;
  for (const auto& trial : trials) {
    const auto [doses, augmented, seconds] = of(trial);
    section.trials.push_back(doses);
    section.augmented += augmented;
    double longest = seconds;  // the question after an aspiration is no time of the trial
    for (const assess::SubtaskDose& dose : doses) longest = std::max(longest, dose.on_s);
    section.seconds += longest;
  }
  return section;
}

}  // namespace palpa::session
