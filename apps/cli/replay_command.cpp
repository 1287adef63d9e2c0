#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/json_text.h"
#include "apps/cli/commands.h"
#include "apps/evidence/recorded_session.h"
#include "apps/evidence/recorded_trials.h"
#include "apps/evidence/session_export.h"
#include "apps/record/session_file.h"
#include "apps/session/finish_session.h"
#include "apps/training/engine.h"

namespace palpa::cli {

using evidence::Likeness;
using training::Engine;

namespace {

/// Trials without a score are named and left out.
bool hasScore(const record::RecordedTrial& trial) {
  if (!trial.ended)
    std::printf("Trial %d was not finished: the program stopped in the middle\n",
                trial.header.trial);
  else if (trial.end.scores_json.empty())
    std::printf("Trial %d has no score (%s)\n", trial.header.trial, trial.end.outcome.c_str());
  return trial.ended && !trial.end.scores_json.empty();
}

const char* wordsOf(Likeness likeness) {
  switch (likeness) {
    case Likeness::same_bits:
      return "";
    case Likeness::rounding:
      return "  differs by rounding";
    case Likeness::changed:
      break;
  }
  return "  DIFFERENT from the recorded score";
}

/// Says a trial's summary, and whether its score is what was recorded.
Likeness sayTrial(const char* what, const record::RecordedTrial& trial, const std::string& summary,
                  const std::string& again_json) {
  const Likeness found = evidence::likenessOfJson(trial.end.scores_json, again_json);
  std::printf("%s %d: %s%s\n", what, trial.header.trial, summary.c_str(), wordsOf(found));
  return found;
}

Likeness needleScores(const std::string& file) {
  const evidence::RecordedSession session(file);
  Likeness worst = Likeness::same_bits;
  session.eachTrial([&](const record::RecordedTrial& trial,
                        const evidence::RecordedSession::Samples& samples) {
    if (!hasScore(trial)) return;
    const nlohmann::json scores = parseJson(trial.end.scores_json);
    if (session.hasGoal()) {
      const assess::TrialAssessment reached = session.rescore(trial, samples);
      const nlohmann::json was{scores.at("TIME"), scores.at("SUCCESS")};
      const nlohmann::json is{reached.values.time_ms, reached.values.success ? 1 : 0};
      const Likeness found = evidence::likenessOfJson(was.dump(), is.dump());
      std::printf("Trial %d: %s%s\n", trial.header.trial, reached.summary.c_str(), wordsOf(found));
      worst = worse(worst, found);
      return;
    }
    if (session.reader().info().expert_path_json.empty()) return;
    const double stored = scores.at("TOTAL").get<double>();
    const double again = session.rescore(trial, samples).total;
    const Likeness found = evidence::likeness(stored, again);
    std::printf("Trial %d: total penalty %.6f recorded, %.6f scored again%s\n", trial.header.trial,
                stored, again, wordsOf(found));
    worst = worse(worst, found);
  });
  return worst;
}

/// Of a task that is judged from its evidence alone: `again` gives what is said of a trial, and its
/// score.
template <class Trials, class Again>
Likeness scoresAgain(const char* what, const Trials& trials, Again again) {
  Likeness worst = Likeness::same_bits;
  for (const auto& trial : trials) {
    if (!hasScore(trial.recorded)) continue;
    const auto [summary, score] = again(trial);
    worst = worse(worst, sayTrial(what, trial.recorded, summary, score));
  }
  return worst;
}

Likeness palpationScores(const record::SessionReader& reader) {
  return scoresAgain("Trial", evidence::recordedPalpations(reader), [](const auto& trial) {
    return std::pair(trial.assessment.summary, task_palpation::scoreJson(trial.assessment));
  });
}

Likeness comparisonScores(const record::SessionReader& reader) {
  return scoresAgain("Trial", evidence::recordedComparisons(reader), [](const auto& trial) {
    return std::pair(summaryOf(trial.again), task_comparison::scoreJson(trial.again));
  });
}

Likeness pulseScores(const record::SessionReader& reader) {
  const assess::PulseRules rules =
      task_pulse::rulesIn(JsonFile::ofText(reader.info().task_json, "the recorded task"));
  return scoresAgain("Trial", evidence::recordedPulses(reader), [&rules](const auto& trial) {
    return std::pair(summaryOf(trial.again, rules), task_pulse::scoreJson(trial.again, rules));
  });
}

Likeness searchScores(const record::SessionReader& reader) {
  return scoresAgain("Episode", evidence::recordedSearches(reader), [](const auto& trial) {
    return std::pair(summaryOf(trial.again), task_search::scoreJson(trial.again));
  });
}

Likeness scoresOf(const record::SessionReader& reader, const std::string& file) {
  switch (evidence::engineOf(reader)) {
    case Engine::palpation:
      return palpationScores(reader);
    case Engine::search:
      return searchScores(reader);
    case Engine::squeeze:
    case Engine::friction:
      return comparisonScores(reader);
    case Engine::pulse:
      return pulseScores(reader);
    case Engine::needle:
      break;
  }
  return needleScores(file);
}

void printForces(const record::SessionReader& reader) {
  const std::optional<assess::ForceBalance> balance = evidence::recordedBalance(reader);
  if (!balance) return;
  std::printf(
      "Hand, device and phantom, each measured by itself, add up to m a: within %.3f N (rms %.4f "
      "N) at %zu samples; the phantom gave up to %.2f N\n",
      balance->largest_N, balance->rms_N, balance->samples, balance->object_N);
}

void printTicks(const evidence::ReplayCheck& check) {
  std::printf("%lld ticks run again: %lld differ", static_cast<long long>(check.ticks),
              static_cast<long long>(check.different));
  if (check.different > check.changed)
    std::printf("; %lld of these by rounding, at most %.1e N",
                static_cast<long long>(check.different - check.changed), check.largest);
  std::printf("%s\n", check.gaps ? " (records are missing)" : "");
}

void replay(const std::string& file) {
  const record::SessionReader reader(file);
  const evidence::ReplayCheck check =
      evidence::replayTicks(reader, evidence::recordedFloors(reader));
  if (check.recorded == 0 && reader.trials().empty())
    throw Error("holds no tick", file,
                "The session ended before the first was written: there is nothing to run again");
  printTicks(check);
  const Likeness all = worse(check.likeness(), scoresOf(reader, file));
  if (all == Likeness::changed)
    throw Error("the replay differs from the record" +
                    (check.changed ? " from tick " + std::to_string(check.first_change) : ""),
                file,
                "By more than rounding: it was changed, or made by a version with other forces or "
                "scores");
  printForces(reader);
  std::printf(all == Likeness::same_bits
                  ? "The replay equals the record: same forces, same score\n"
                  : "The replay differs from the record by rounding only: it was made on another "
                    "processor or by an older version\n");
}

}  // namespace

void addReplay(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "replay",
      "Run a recorded session again: same forces, same score; or see a trial of it again");
  command->footer(
      "Examples:\n  palpa replay out/subclavian-20260301-120000/session.palpa\n  palpa replay "
      "out/A/session.palpa --view --trial 2 --speed 0.5\n  palpa replay out/A/session.palpa "
      "--video trial.mp4\n  palpa replay out/A/session.palpa --pictures moments --fps 5 --size "
      "960x540\n  palpa replay out/search/session.palpa --figures figures --trial 2");
  const auto file = std::make_shared<std::string>();
  const auto seen = std::make_shared<ReplayViewOptions>();
  command->add_option("session", *file, "session.palpa")->required()->type_name("FILE");
  addReplayViewOptions(*command, *seen);
  command->callback([file, seen, command] {
    const bool figures = !seen->figures.empty();
    if (seen->view + !seen->video.empty() + !seen->pictures.empty() + figures > 1)
      throw UsageError("do not go together", "--view, --video, --pictures and --figures",
                       "Give one of them");
    for (const char* option : {"--trial", "--speed", "--from", "--to", "--fps", "--size",
                               "--show-map", "--window", "--monitor", "--gpu"})
      if (!seen->wanted() && command->count(option) > 0 &&
          !(figures && option == std::string("--trial")))
        throw UsageError("has an effect only when a trial is shown again", option,
                         "Add --view, --video FILE or --pictures DIR");
    if (figures)
      writeReplayFigures(*file, *seen);
    else if (seen->wanted())
      viewReplay(*file, *seen);
    else
      replay(*file);
  });
}

namespace {

constexpr const char* kExportExamples = R"(Examples:
  palpa export out/A/session.palpa --out ticks.csv
      ticks.csv: every tick, with every force that was added, the parts and cues that were on, and
      where they were; ticks.columns.txt says what its columns are, ticks.laws.json by which laws
  python3 docs/check_ticks.py ticks.csv
      adds every force up and computes the cues again
What a force is made of is not in the record: the ticks are run again for it, as by palpa replay.)";

}  // namespace

void addExport(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("export", "Write a session's 1 kHz samples as CSV, with a dictionary");
  command->footer(kExportExamples);
  const auto file = std::make_shared<std::string>(),
             out = std::make_shared<std::string>("ticks.csv");
  command->add_option("session", *file, "session.palpa")->required()->type_name("FILE");
  command->add_option("--out", *out, "CSV to write")->type_name("FILE");
  command->callback([file, out] {
    const evidence::SessionExport exported =
        evidence::exportSession(record::SessionReader(*file), *out);
    const std::int64_t alone =
        exported.check.recorded - exported.check.ticks + exported.check.changed;
    if (alone > 0)
      std::printf(
          "%lld ticks could not be run again, or came out changed: what their force is made "
          "of is empty\n",
          static_cast<long long>(alone));
    std::printf("Written: %s, %s, %s\n", exported.files[0].c_str(), exported.files[1].c_str(),
                exported.files[2].c_str());
  });
}

namespace {

constexpr const char* kFinishExamples = R"(Examples:
  palpa finish
      which sessions ended before their report: killed, or the computer stopped
  palpa finish out/subclavian-20260301-120000
      makes the report and the table of one from its evidence, and brings its trials into the records noted for it
  palpa finish out/A/session.palpa --again
      makes both again, where they are there already
Trials that were finished are judged as the session would have; one that was not is named, and not scored.)";

void listUnfinished() {
  const auto left = session::unfinishedSessions();
  if (left.empty()) std::printf("Every session noted here was finished\n");
  for (const std::filesystem::path& folder : left) std::printf("palpa finish %s\n", folder.c_str());
}

}  // namespace

void addFinish(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "finish", "Report and table of a session whose program ended before it wrote them");
  command->footer(kFinishExamples);
  const auto given = std::make_shared<std::string>();
  const auto again = std::make_shared<bool>(false);
  command
      ->add_option("session", *given,
                   "A session's folder, or its session.palpa; without it, which there are")
      ->type_name("FOLDER");
  command->add_flag(
      "--again", *again,
      "Make both again, where they are there, without what only the running program knew");
  command->callback([given, again] {
    if (given->empty() && *again)
      throw UsageError("needs the folder of a session", "--again", "Say which one");
    if (given->empty()) return listUnfinished();
    session::finishSession(*given, *again ? session::FinishAgain::yes : session::FinishAgain::no);
  });
}

}  // namespace palpa::cli
