#include "apps/evidence/recorded_show.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "apps/evidence/needle_track.h"
#include "apps/evidence/recorded_trials.h"
#include "apps/report/page/style.h"
#include "apps/task_needle/near_miss_watch.h"
#include "apps/training/engine.h"

namespace palpa::evidence {
namespace {

scene::TickTone tickOf(const std::string& kind) {
  switch (report::toneOfMoment(kind)) {
    case report::Tone::good:
      return scene::TickTone::good;
    case report::Tone::guide:
      return scene::TickTone::guide;
    case report::Tone::bad:
      return scene::TickTone::bad;
    case report::Tone::neutral:
      break;
  }
  return scene::TickTone::neutral;
}

void addNearMiss(std::vector<replay::StripMark>& marks, double distance_mm, double at_s,
                 const char* organ) {
  if (!std::isfinite(distance_mm) || distance_mm > 1e3 * task_needle::kNearMiss || at_s < 0) return;
  char words[96];
  if (distance_mm > 0)
    std::snprintf(words, sizeof words, "Near miss: %.1f mm from %s", distance_mm, organ);
  else
    std::snprintf(words, sizeof words, "Deepest in %s: %.1f mm", organ, -distance_mm);
  marks.push_back({at_s, distance_mm > 0 ? scene::TickTone::guide : scene::TickTone::bad, words,
                   distance_mm > 0});
}

std::vector<replay::StripMark> marksOf(const assess::TrialAssessment& judged) {
  std::vector<replay::StripMark> marks;
  for (const assess::Moment& moment : judged.moments)
    marks.push_back({moment.t_s, tickOf(moment.kind), moment.text, false});
  addNearMiss(marks, judged.closest_pleura_mm, judged.closest_pleura_s, "the pleura");
  addNearMiss(marks, judged.closest_artery_mm, judged.closest_artery_s, "an artery");
  std::stable_sort(
      marks.begin(), marks.end(),
      [](const replay::StripMark& a, const replay::StripMark& b) { return a.t_s < b.t_s; });
  return marks;
}

/// Judged again, for its marks, and its way drawn; nothing where it cannot be.
void judgeAgain(RecordedNeedleTrial* show) {
  const RecordedSession& session = show->session;
  if (!session.hasGoal() && session.reader().info().expert_path_json.empty()) return;
  const std::optional<assess::NeedleViews> views = session.views();
  session.eachTrial(
      [&](const record::RecordedTrial& trial, const RecordedSession::Samples& samples) {
        if (trial.header.trial != show->trial.number || samples.empty()) return;
        show->trial.marks = marksOf(session.rescore(trial, samples));
        if (views) show->way = needleTrack(*views, samples);
      });
}

}  // namespace

const record::RecordedTrial& chosenTrial(const std::vector<record::RecordedTrial>& trials,
                                         const std::filesystem::path& file, int number) {
  const auto found =
      std::find_if(trials.begin(), trials.end(), [&](const record::RecordedTrial& t) {
        return number == 0 ? t.ended : t.header.trial == number;
      });
  if (found == trials.end())
    throw UsageError(
        number == 0 ? "has no finished trial" : "has no trial " + std::to_string(number),
        file.string(), "It has " + counted(trials.size(), "trial") + ", numbered from 1");
  return *found;
}

std::unique_ptr<RecordedShow> recordedShow(const std::filesystem::path& file, int number) {
  const training::Engine engine = engineOf(record::SessionReader(file));
  if (engine != training::Engine::needle) return recordedTouch(file, engine, number);
  return std::make_unique<RecordedNeedleTrial>(file, number);
}

RecordedNeedleTrial::RecordedNeedleTrial(const std::filesystem::path& file, int number)
    : session(file), films(file.parent_path()) {
  const record::RecordedTrial& one = chosenTrial(session.trials(), file, number);
  trial.number = one.header.trial;
  trial.force_feedback = one.header.force_feedback;
  trial.X_AD = session.X_DA().inverse();
  trial.words = session.words();
  trial.mark = session.simulated() ? "REPLAY: SIMULATED" : "REPLAY";
  replay::MomentReader reader(trial.X_AD, session.reader().info().tick_config.X_ET, trial.number);
  session.reader().ticks([&](const haptics::FlightRecord& record) {
    if (!one.isOver(record.t_ns)) reader.add(record);
  });
  trial.moments = reader.moments();
  if (trial.moments.empty())
    throw Error("has no ticks of trial " + std::to_string(trial.number), file.string(),
                "The program stopped before it began");
  judgeAgain(this);
}

}  // namespace palpa::evidence
