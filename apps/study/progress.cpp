#include "apps/study/progress.h"

#include <algorithm>

#include "anatomy/base/utc.h"

namespace palpa::study {
namespace {

int countOf(const std::vector<DoneTrial>& trials, std::int64_t step) {
  return static_cast<int>(std::count_if(trials.begin(), trials.end(), [&](const DoneTrial& t) {
    return t.step == step && t.counts();
  }));
}

std::vector<std::string> clockRemarks(const std::vector<DoneTrial>& trials,
                                      const std::string& now_utc) {
  std::vector<std::string> remarks;
  const auto add = [&](const std::string& remark) {
    if (remarks.empty() || remarks.back() != remark) remarks.push_back(remark);
  };
  for (std::size_t i = 1; i < trials.size(); ++i)
    if (utcSecondsOf(trials[i].began_utc) < utcSecondsOf(trials[i - 1].began_utc))
      add("A session is dated " + trials[i].began_utc + ", before the one that came before it (" +
          trials[i - 1].began_utc + "): a clock was changed; the order in which they came counts");
  if (!trials.empty() && utcSecondsOf(now_utc) < utcSecondsOf(trials.back().began_utc))
    add("This station's clock says " + now_utc + ", which is before the last session (" +
        trials.back().began_utc + "): check the clock");
  return remarks;
}

/// s. A clock that went back makes no rest longer than it is.
double restDue(const Block& block, const DoneTrial& last, const std::string& now_utc) {
  const double since =
      std::chrono::duration<double>(utcSecondsOf(now_utc) - utcSecondsOf(last.began_utc)).count() -
      last.ended_s;
  return std::clamp(block.rest_s - std::max(0.0, since), 0.0, block.rest_s);
}

/// Of the last trial's block, where it stopped at a rest.
double restAfter(const Protocol& protocol, const std::vector<DoneTrial>& trials,
                 std::int64_t next_step, const std::string& now_utc) {
  if (trials.empty()) return 0;
  const DoneTrial& last = trials.back();
  const Block& block = protocol.block(last.step);
  if (protocol.sessionOf(last.step) != protocol.sessionOf(next_step))
    return 0;  // days are between them, or none
  const bool stopped = last.step != next_step ||
                       (block.rest_after && countOf(trials, last.step) % block.rest_after == 0);
  return stopped ? restDue(block, last, now_utc) : 0;
}

/// A date before which the session cannot begin; empty: it can.
std::string earliest(const Session& session, const std::vector<DoneTrial>& trials,
                     const std::string& now_utc) {
  if (session.days_after == 0 || trials.empty()) return "";
  const std::chrono::sys_days first =
      utcDayOf(trials.back().began_utc) + std::chrono::days(session.days_after);
  return utcDayOf(now_utc) < first ? isoDate(first) : "";
}

Next blockNext(const Protocol& protocol, const std::string& drawn,
               const std::vector<DoneTrial>& trials, const Block& block,
               const std::string& now_utc) {
  Next next;
  next.kind = NextKind::trials;
  next.session = protocol.sessionOf(block.step);
  next.step = block.step;
  next.condition = block.condition.empty() ? drawn : block.condition;
  next.done = countOf(trials, block.step);
  next.left = block.trials - next.done;
  next.trials = block.rest_after
                    ? std::min(next.left, block.rest_after - next.done % block.rest_after)
                    : next.left;
  next.rest_s = restAfter(protocol, trials, block.step, now_utc);
  const Session& session = protocol.sessions[static_cast<std::size_t>(next.session - 1)];
  if (block.step == session.blocks.front().step && next.done == 0)
    next.not_before = earliest(session, trials, now_utc);
  return next;
}

std::vector<std::string> openItems(const Questionnaire& questionnaire, int session,
                                   const std::vector<std::pair<int, std::string>>& answered) {
  std::vector<std::string> open;
  for (const Item& item : questionnaire.items)
    if (std::find(answered.begin(), answered.end(), std::pair(session, item.id)) == answered.end())
      open.push_back(item.id);
  return open;
}

}  // namespace

DoneTrial doneTrial(const record::StoredSession& session, const record::StoredTrial& trial) {
  return {session.slot, session.uuid, session.started_utc, 1e-9 * static_cast<double>(trial.end_ns),
          trial.outcome};
}

Next nextOf(const Protocol& protocol, const std::string& drawn,
            const std::vector<DoneTrial>& trials,
            const std::vector<std::pair<int, std::string>>& answered, const std::string& now_utc) {
  Next next;
  int number = 0;
  for (const Session& session : protocol.sessions) {
    ++number;
    for (const Block& block : session.blocks) {
      if (countOf(trials, block.step) >= block.trials) continue;
      next = blockNext(protocol, drawn, trials, block, now_utc);
      next.remarks = clockRemarks(trials, now_utc);
      return next;
    }
    if (!session.questionnaire) continue;
    next.open_items = openItems(*session.questionnaire, number, answered);
    if (next.open_items.empty()) continue;
    next.kind = NextKind::questionnaire;
    next.session = number;
    return next;
  }
  next.session = number;
  return next;
}

std::string whereIs(const study::Protocol& protocol, const Next& next) {
  const std::string session =
      "session " + std::to_string(next.session) + " of " + std::to_string(protocol.sessions.size());
  switch (next.kind) {
    case NextKind::finished:
      return "finished";
    case NextKind::questionnaire:
      return session + ", questionnaire: " + std::to_string(next.open_items.size()) + " open";
    case NextKind::trials:
      break;
  }
  const study::Block& block = protocol.block(next.step);
  return session + ", " + block.name + ": " + std::to_string(next.done) + " of " +
         std::to_string(block.trials) + " trials" +
         (next.not_before.empty() ? "" : ", not before " + next.not_before);
}

}  // namespace palpa::study
