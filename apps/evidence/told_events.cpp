#include "apps/evidence/told_events.h"

#include <algorithm>
#include <map>
#include <vector>

#include <nlohmann/json.hpp>

#include "anatomy/base/json_text.h"
#include "anatomy/base/utc.h"
#include "apps/report/needle/trial_chart.h"
#include "apps/runtime/clock.h"
#include "apps/training/trial_clock.h"

namespace palpa::evidence {

using runtime::EventKind;

namespace {

/// "Touched: lung": lung.
std::string meaning(const runtime::Event& event) {
  if (!event.is(EventKind::touched) && !event.is(EventKind::wall)) return event.kind;
  const std::size_t at = event.text.rfind(": ");
  return at == std::string::npos ? event.kind : event.text.substr(at + 2);
}

}  // namespace

std::string toneOfEvent(const runtime::Event& event) {
  if (event.is(EventKind::note)) return "note";
  if (event.is(EventKind::safety) && event.text == runtime::kForceIsBack) return "neutral";
  switch (report::toneOfMoment(meaning(event))) {
    case report::Tone::good:
      return "good";
    case report::Tone::guide:
      return "guide";
    case report::Tone::bad:
      return "bad";
    case report::Tone::neutral:
      break;
  }
  return "neutral";
}

namespace {

bool inVirtualTime(const record::SessionInfo& info) {
  const nlohmann::json session = parseJson(info.session_json);
  return session.is_object() && session.value("virtual_time", false);
}

/// Notes with the trial that each is about, and when in it.
void addNotes(const record::SessionReader& session, std::vector<report::Remark>* remarks) {
  std::vector<runtime::Event> notes = session.events();
  std::erase_if(notes, [](const runtime::Event& event) { return !event.is(EventKind::note); });
  if (notes.empty()) return;
  const auto trials = session.trials();
  const std::map<int, training::TrialTimes> times = trialTimes(session);
  for (const runtime::Event& note : notes) {
    const std::int64_t then_ns = note.about_ns();
    const auto trial = std::find_if(trials.begin(), trials.end(), [&](const auto& one) {
      return one.header.t_ns <= then_ns && !one.isOver(then_ns);
    });
    const int number = trial == trials.end() ? 0 : trial->header.trial;
    const auto its = times.find(number);
    remarks->push_back({number, its == times.end() ? 0 : its->second.at(then_ns), note.text});
  }
}

}  // namespace

report::SessionPage whatWasNoted(const record::SessionReader& session) {
  report::SessionPage page;
  if (const record::SessionInfo& info = session.info(); !inVirtualTime(info))
    page.when =
        runtime::dateText("%-d %B %Y, %H:%M", runtime::Zone::local, utcSecondsOf(info.started_utc));
  addNotes(session, &page.remarks);
  return page;
}

}  // namespace palpa::evidence
