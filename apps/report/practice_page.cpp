#include "apps/report/practice_page.h"

#include <algorithm>

#include "apps/report/page_parts.h"
#include "apps/report/progress_style.h"

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

void writePracticeMain(Html& html, const std::vector<progress::PracticeTrial>& trials,
                       const std::function<void(Html&, const progress::Series&)>& series) {
  const std::vector<progress::Series> all = progress::seriesOf(trials);
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
  if (const std::string left = progress::leftOut(trials); !left.empty())
    html.element("p", {{"class", "muted small"}}, "Left out of every figure: " + left + '.');
}

}  // namespace

void writeSeriesHeading(Html& html, const progress::Series& series) {
  std::string name = series.name();
  if (!name.empty() && name[0] >= 'a' && name[0] <= 'z')
    name[0] = static_cast<char>(name[0] - 'a' + 'A');
  html.element("h2", name);
}

std::string practiceHtml(const PracticePage& page,
                         const std::vector<progress::PracticeTrial>& trials,
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
    writePracticeMain(html, trials, series);
    const auto footer = html.in("footer");
    html.element("p", {{"class", "muted small"}},
                 page.footer + " Palpa has not been validated on people.");
    if (!page.software.empty())
      html.element("p", {{"class", "muted small"}}, "Made by " + page.software + '.');
  }
  return html.str();
}

}  // namespace palpa::report
