#include "apps/report/needle/trial_sections.h"

#include <cmath>

#include "anatomy/base/counted.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/page/style.h"

namespace palpa::report {
namespace {

using competence::Mark;
using competence::Status;

Tone toneOf(Status status) {
  return status == Status::passed ? Tone::good : status == Status::failed ? Tone::bad : Tone::guide;
}

const char* signOf(Mark mark) {
  switch (mark) {
    case Mark::done:
      return "✓";
    case Mark::not_done:
      return "✗";
    case Mark::did_not_arise:
      return "–";
    default:
      return "□";
  }
}

const char* cssOf(Mark mark) {
  return mark == Mark::done ? "good" : mark == Mark::not_done ? "bad" : "open";
}

/// An error begins where the puncture is in danger, points where a hand leaves the experts' range.
std::string noErrorWords(const assess::TrialAssessment& trial) {
  const std::string none = "None of the six common errors of this procedure was made.";
  return trial.total > 0 ? none +
                               " Smaller faults, farther off than experts vary, still cost "
                               "points; the score says how many."
                         : none;
}

void writeErrors(Html& html, const assess::TrialAssessment& trial) {
  html.element("h3", "Errors of technique");
  if (trial.errors.empty()) {
    html.element("p", trial.skin_punctures ? noErrorWords(trial)
                                           : "The needle was not inserted: there is no technique "
                                             "to judge.");
    return;
  }
  const auto list = html.in("ul", {{"class", "errors"}});
  for (const assess::TechnicalError& error : trial.errors) {
    const auto item = html.in("li", {{"class", "dot bad"}});
    html.element("strong", error.title);
    html.element("span", {{"class", "time"}}, fixed(error.t_s, 1) + " s");
    html.element("p", error.sentence);
  }
}

/// Floor: 97.96 % are not 98 %.
std::string shareText(double share) {
  return trimmed(std::floor(1e3 * share + 1e-9) / 10, 1) + " %";
}

std::string scoreText(const competence::Verdict& v) {
  const competence::ChecklistScore& s = v.score;
  const std::string share =
      s.open ? "between " + shareText(s.low) + " and " + shareText(s.high) : shareText(s.low);
  const std::string left_out =
      s.did_not_arise ? " " + counted(s.did_not_arise, "item") +
                            " did not arise: left out of this share, and counted as done in the "
                            "level."
                      : "";
  return std::to_string(s.done) + " of " + std::to_string(s.done + s.not_done + s.open) +
         " items done (" + share + "; " + shareText(v.standard) + " asked for)." + left_out +
         " Level: " + v.level + ", by " + std::to_string(s.major_done) + " of " +
         std::to_string(s.major) + " major and " + std::to_string(s.minor_done) + " of " +
         std::to_string(s.minor) + " minor items" + (s.open ? " so far." : ".");
}

void writeChecklist(Html& html, const competence::Verdict& v) {
  html.element("h3", "Checklist");
  html.element("p", scoreText(v));
  const auto scroll = html.in("div", {{"class", "scroll"}});
  const auto table = html.in("table", {{"class", "checklist"}});
  {
    const auto head = html.in("thead");
    const auto row = html.in("tr");
    for (const char* title : {"Item", "Weight", "Judged by", "Result"})
      html.element("th", {{"scope", "col"}}, title);
  }
  const auto body = html.in("tbody");
  for (const competence::MarkedItem& m : v.items) {
    const auto row = html.in("tr");
    {
      const auto cell = html.in("td");
      html.text(m.item->text);
      if (!m.why.empty() && m.mark != Mark::done)
        html.element("p", {{"class", "muted small"}}, m.why);
    }
    html.element("td", m.item->major ? "major" : "minor");
    html.element("td", m.item->byRater() ? "rater" : "simulator");
    html.element("td", {{"class", std::string("result ") + cssOf(m.mark)}},
                 std::string(signOf(m.mark)) + " " + competence::markWords(m.mark));
  }
}

void writePassOrFail(Html& html, const TrialPage& page) {
  const competence::Verdict& v = *page.verdict;
  html.element("h3", "Pass or fail");
  {
    const auto box =
        html.in("div", {{"class", std::string("judgement ") + cssClass(toneOf(v.status))}});
    html.element("p", {{"class", "outcome"}},
                 std::string(competence::statusWords(v.status)) +
                     (page.assessment.simulated ? " (simulated)" : ""));
    for (const std::string& reason : v.reasons) html.element("p", reason);
    if (v.reasons.empty())
      html.element("p",
                   "The checklist reaches the standard, the global rating its cut-off, and no "
                   "critical error was made.");
    if (v.global_mean)
      html.element("p", "Global rating: " + trimmed(*v.global_mean, 1) + " of 5 on average.");
  }
  if (!page.certification.empty())
    html.element("p", {{"class", "muted small"}}, page.certification);
  writeChecklist(html, v);
}

}  // namespace

void writeCompetence(Html& html, const TrialPage& page) {
  if (!page.assessment.by_path || page.assessment.penalties.empty()) return;
  writeErrors(html, page.assessment);
  if (page.verdict) writePassOrFail(html, page);
}

std::string_view competenceStyle() {
  return R"css(
.errors{list-style:none;margin:0;padding:0}
.errors li{padding:.5rem 0;border-bottom:1px solid var(--line)}
.errors li:last-child{border-bottom:0}
.errors .time{margin:0 0 0 .8rem;color:var(--muted)}
.errors p{margin:.1rem 0 0}
.judgement{padding:14px 20px;border-radius:10px;--tone:var(--plain);border-left:6px solid var(--tone);
  background:color-mix(in srgb,var(--tone) 9%,var(--card))}
.judgement.good{--tone:var(--good)}
.judgement.bad{--tone:var(--bad)}
.judgement.guide{--tone:var(--guide)}
.judgement p{margin:0 0 .3rem}
.judgement+.small{margin-top:.7rem}
.checklist{width:100%;border-collapse:collapse;font-size:.925rem}
.checklist th{text-align:left;font-size:.85rem;font-weight:400;color:var(--muted);padding:0 1rem .35rem 0;border-bottom:1px solid var(--line)}
.checklist td{padding:.4rem 1rem .4rem 0;border-bottom:1px solid var(--line);vertical-align:top}
.checklist td p{margin:0}
.checklist .result{white-space:nowrap;padding-right:0}
.checklist .result.good{color:var(--good-ink)}
.checklist .result.bad{color:var(--bad-ink);font-weight:600}
.checklist .result.open{color:var(--muted)}
@media print{.checklist tr,.errors li,.judgement{break-inside:avoid}}
svg .curve.beside{stroke:var(--guide);stroke-dasharray:9 3 2 3;stroke-width:1.8}
)css";
}

}  // namespace palpa::report
