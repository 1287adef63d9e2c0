#include "apps/evidence/told_events.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "anatomy/base/json_text.h"
#include "anatomy/base/utc.h"
#include "apps/report/needle/trial_chart.h"
#include "apps/runtime/clock.h"

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

/// When it was begun, where somebody noted it so; else when it came.
std::int64_t noted(const runtime::Event& event) {
  return event.value > 0 ? static_cast<std::int64_t>(event.value * 1e9) : event.t_ns;
}

bool inVirtualTime(const record::SessionInfo& info) {
  const nlohmann::json session = parseJson(info.session_json);
  return session.is_object() && session.value("virtual_time", false);
}

}  // namespace

report::SessionPage whatWasNoted(const record::SessionReader& session) {
  report::SessionPage page;
  if (const record::SessionInfo& info = session.info(); !inVirtualTime(info))
    page.when =
        runtime::dateText("%-d %B %Y, %H:%M", runtime::Zone::local, utcSecondsOf(info.started_utc));
  const auto trials = session.trials();
  for (const runtime::Event& event : session.events()) {
    if (!event.is(EventKind::note)) continue;
    const std::int64_t then_ns = noted(event);
    const auto trial = std::find_if(trials.begin(), trials.end(), [&](const auto& one) {
      return one.header.t_ns <= then_ns && !one.isOver(then_ns);
    });
    if (trial == trials.end())
      page.remarks.push_back({0, 0, event.text});
    else
      page.remarks.push_back({trial->header.trial,
                              1e-9 * static_cast<double>(then_ns - trial->header.t_ns),
                              event.text});
  }
  return page;
}

}  // namespace palpa::evidence
