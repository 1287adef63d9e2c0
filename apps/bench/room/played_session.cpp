#include "apps/bench/room/room_parts.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <vector>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/uuid.h"
#include "apps/evidence/evidence_records.h"
#include "apps/evidence/told_events.h"
#include "apps/live/live_session.h"
#include "apps/os/signals.h"
#include "apps/record/session_file.h"
#include "apps/runtime/clock.h"

namespace palpa::bench {
namespace {

constexpr std::int64_t kCommit = 100 * runtime::kMillisecond;  // as a session's recorder

/// Everything that a record holds, each with its time, in the order in which it was written down.
struct Score {
  struct Note {
    std::int64_t t_ns = 0;
    std::function<void(runtime::FlightSink&)> plays;
  };
  record::SessionInfo info;
  std::vector<haptics::FlightRecord> ticks;
  std::vector<Note> notes;
  std::vector<record::RecordedTrial> trials;
};

Score scoreIn(const std::filesystem::path& recorded) {
  const record::SessionReader reader(recorded);
  Score score;
  score.info = reader.info();
  reader.ticks([&](const haptics::FlightRecord& tick) { score.ticks.push_back(tick); });
  score.trials = reader.trials();
  const auto note = [&score](std::int64_t t_ns, std::function<void(runtime::FlightSink&)> plays) {
    score.notes.push_back({t_ns, std::move(plays)});
  };
  for (const record::RecordedTrial& trial : score.trials)
    note(trial.header.t_ns, [trial](runtime::FlightSink& sink) { sink.beginTrial(trial.header); });
  reader.snapshots([&](const LocalGeometry& geometry) {
    note(geometry.t_ns, [geometry](runtime::FlightSink& sink) { sink.snapshot(geometry); });
  });
  for (const runtime::Event& event : reader.events())
    note(event.t_ns, [event](runtime::FlightSink& sink) { sink.event(event); });
  for (const record::RecordedTrial& trial : score.trials)
    if (trial.ended)
      note(trial.end.t_ns, [trial](runtime::FlightSink& sink) { sink.endTrial(trial.end); });
  std::size_t at = 0;
  reader.keyframes([&](std::int64_t number, const haptics::TickState& state) {
    while (at + 1 < score.ticks.size() && score.ticks[at].tick < number) ++at;
    const std::int64_t t_ns = score.ticks.empty() ? 0 : score.ticks[at].t_ns;
    note(t_ns, [number, state](runtime::FlightSink& sink) { sink.keyframe(number, state); });
  });
  std::stable_sort(score.notes.begin(), score.notes.end(),
                   [](const auto& a, const auto& b) { return a.t_ns < b.t_ns; });
  return score;
}

/// The new session's own name, trainee and beginning.
record::SessionInfo infoFor(record::SessionInfo info, const std::string& trainee) {
  info.uuid = newUuid();
  info.started_utc = runtime::utcNow();
  nlohmann::json session = parseJson(info.session_json);
  session["trainee"] = trainee;
  info.session_json = session.dump();
  return info;
}

/// What the screen would say.
trial::TrialStatus statusAt(const Score& score, std::int64_t now_ns) {
  trial::TrialStatus status;
  status.state = trial::TrialState::waiting;
  status.trials = static_cast<int>(score.trials.size());
  for (const record::RecordedTrial& trial : score.trials) {
    if (trial.header.t_ns > now_ns) break;
    status.trial = trial.header.trial;
    status.role = training::Role::scored;
    status.state = trial.isOver(now_ns) ? trial::TrialState::ended : trial::TrialState::running;
    status.elapsed_s = 1e-9 * static_cast<double>(now_ns - trial.header.t_ns);
  }
  return status;
}

void playAll(const Score& score, runtime::FlightSink& sink, live::LiveSession& session) {
  const os::InterruptNote interrupt(os::InterruptNote::Again::noted);
  const runtime::SteadyClock clock;
  const std::int64_t start = score.ticks.empty() ? 0 : score.ticks.front().t_ns;
  auto tick = score.ticks.begin();
  auto note = score.notes.begin();
  for (std::int64_t due = kCommit; !interrupt.noted(); due += kCommit) {
    clock.sleepUntil(due);
    const std::int64_t now_ns = start + due;
    for (; tick != score.ticks.end() && tick->t_ns <= now_ns; ++tick) {
      for (; note != score.notes.end() && note->t_ns <= tick->t_ns; ++note) note->plays(sink);
      sink.tick(*tick);
    }
    if (tick == score.ticks.end())
      for (; note != score.notes.end(); ++note) note->plays(sink);
    sink.commit();
    session.show({}, statusAt(score, now_ns), now_ns);
    if (tick == score.ticks.end()) return;
  }
}

}  // namespace

void playSession(const PlayedSession& played) {
  const Score score = scoreIn(played.recorded);
  const record::SessionInfo info = infoFor(score.info, played.trainee);
  const std::filesystem::path evidence = played.out / "session.palpa";
  {
    record::SessionWriter writer(evidence, info);
    trial::Channels channels;
    runtime::StopSwitch stop;
    live::LiveSession session(played.live,
                              {.uuid = info.uuid,
                               .task = "paracentesis",
                               .trainee = played.trainee,
                               .simulated = true,
                               .trials = static_cast<int>(score.trials.size())},
                              channels, stop);
    live::LiveSink sink(writer, session.log(), {}, evidence::toneOfEvent);
    playAll(score, sink, session);
    session.end();
    writer.close();
  }
  if (played.records.empty()) return;
  try {
    evidence::deliverEvidence(evidence, played.records);
  } catch (const Error& e) {  // in the log of the session, where somebody looks for it
    std::fprintf(stderr, "%s\n", e.what());
  }
}

}  // namespace palpa::bench
