#include "apps/session/event_tone.h"

#include "apps/report/page/style.h"

namespace palpa::session {

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

}  // namespace palpa::session
