#include "apps/report/practice/practice_page.h"

#include <algorithm>

#include "apps/report/page/page_parts.h"

namespace palpa::report {
namespace {

void writePracticeHeader(Html& html, const PracticePage& page, bool simulated) {
  const auto header = html.in("header");
  html.element("h1", page.heading);
  {
    const auto who = html.in("p", {{"class", "who"}});
    for (const auto& [name, value] : page.who) {
      if (value.empty()) continue;
      const auto span = html.in("span");
      html.text(name + ' ');
      html.element("strong", value);
    }
  }
  if (simulated) writeSimulatedBanner(html);
}

void writePracticeMain(Html& html, std::vector<progress::PracticeTrial> trials,
                       const std::function<void(Html&, const progress::Series&)>& series) {
  const std::string left = progress::leftOut(trials);
  const std::vector<progress::Series> all = progress::seriesOf(std::move(trials));
  const auto main = html.in("main");
  if (all.empty())
    html.element("p", {{"class", "card"}},
                 "No trial counts yet: none was both scored and finished.");
  if (all.size() > 1)
    html.element("p", {{"class", "apart muted"}},
                 "Trials of different kinds are kept apart: another task, with or without force "
                 "feedback, cues or guidance, simulated or not.");
  for (const progress::Series& one : all) {
    const auto section = html.in("section", {{"class", "card series"}});
    writeSeriesHeading(html, one);
    series(html, one);
  }
  if (!left.empty())
    html.element("p", {{"class", "muted small"}}, "Left out of every figure: " + left + '.');
}

}  // namespace

void writeSeriesHeading(Html& html, const progress::Series& series) {
  std::string name = series.name();
  if (!name.empty() && name[0] >= 'a' && name[0] <= 'z')
    name[0] = static_cast<char>(name[0] - 'a' + 'A');
  html.element("h2", name);
}

std::string practiceHtml(const PracticePage& page, std::vector<progress::PracticeTrial> trials,
                         const std::function<void(Html&, const progress::Series&)>& series) {
  Html html;
  html.raw("<!doctype html>\n");
  {
    const auto root = html.in("html", {{"lang", "en"}});
    writeHeadElement(html, page.title, page.name, progressStyle());
    const auto body = html.in("body");
    writePracticeHeader(html, page,
                        std::any_of(trials.begin(), trials.end(),
                                    [](const progress::PracticeTrial& t) { return t.simulated; }));
    writePracticeMain(html, std::move(trials), series);
    const auto footer = html.in("footer");
    html.element("p", {{"class", "muted small"}},
                 page.footer + " Palpa has not been validated on people.");
    if (!page.software.empty())
      html.element("p", {{"class", "muted small"}}, "Made by " + page.software + '.');
  }
  return html.page();
}

namespace {

constexpr std::string_view kProgressStyle = R"css(
.short{margin:0;padding-left:1.3rem}
.short li{margin:0 0 .55rem;padding-left:.2rem}
.short strong{font-weight:650}
.short .warn{color:var(--bad-ink);font-weight:600}
.apart{margin-top:1rem}
.behind{margin:.6rem 0 0}
.behind summary{cursor:pointer;color:var(--blue);font-size:.9rem}
.data{border-collapse:collapse;font-size:.85rem;margin:.6rem 0 0;min-width:50%}
.data th,.data td{text-align:right;padding:.35rem .8rem .35rem 0;border-bottom:1px solid var(--line);font-weight:400}
.data td,.data th:first-child{vertical-align:top}
.data td{white-space:nowrap}
.data th:first-child,.data .words{text-align:left}
.data td.words{white-space:normal;min-width:6rem}
.data td.words:last-child{min-width:13rem}
.data thead th{color:var(--muted);vertical-align:bottom}
.behind+.course,.course+.course{margin-top:1.8rem}
.behind+h4,.course+h4,h3+h4{margin:1.6rem 0 .3rem}
.course+h3,.behind+h3,.scroll+h3{margin-top:2.2rem}
.short ul{margin:.3rem 0 0;padding-left:1.2rem}
svg .band{fill:var(--blue);fill-opacity:.14;stroke:none}
svg .curve.fitted{stroke:var(--blue);stroke-width:2.4}
svg .curve.own{stroke:var(--muted);stroke-width:1;stroke-opacity:.55}
svg .curve.sum{stroke:var(--ink);stroke-width:1.6}
svg .session{stroke:var(--plain);stroke-opacity:.5;stroke-dasharray:2 4}
svg .limit{stroke-width:1.6}
svg .limit.accept{stroke:var(--good-ink);stroke-dasharray:9 4}
svg .limit.reject{stroke:var(--bad-ink);stroke-dasharray:3 3}
svg .whisker{stroke:var(--ink);stroke-width:2;stroke-linecap:round}
svg .dot-share{fill:var(--blue);stroke:var(--card);stroke-width:2}
svg .dot-own{fill:none;stroke:var(--muted);stroke-width:1.2}
svg .group-mean{stroke:var(--blue);stroke-width:1.6;stroke-dasharray:6 4}
svg .row-back{fill:var(--lane)}
svg .row-back.odd{fill:none}
@media print{
  .behind{display:none}
  h4{break-after:avoid}
  .series+.series{break-before:page}
  .short li,.course{break-inside:avoid}
}
)css";

}  // namespace

std::string_view progressStyle() { return kProgressStyle; }

}  // namespace palpa::report
