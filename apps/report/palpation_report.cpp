#include "apps/report/palpation_report.h"

#include <algorithm>

#include "anatomy/geometry/whole_file.h"
#include "apps/report/html.h"
#include "apps/report/page_parts.h"
#include "apps/report/palpation_section.h"
#include "apps/report/palpation_style.h"
#include "apps/report/palpation_totals.h"

namespace palpa::report {
namespace {

bool isSimulatedPalpation(const PalpationReport& report) {
  return report.simulated ||
         std::any_of(report.trials.begin(), report.trials.end(),
                     [](const PalpationPage& page) { return page.assessment.facts.simulated; });
}

void writePalpationLinks(Html& html, const PalpationReport& report) {
  if (report.trials.size() < 2) return;
  const auto nav = html.in("nav", {{"aria-label", "Trials"}});
  html.element("a", {{"href", "#totals"}}, "All trials");
  for (const PalpationPage& page : report.trials) {
    const std::string number = std::to_string(page.assessment.facts.trial);
    const std::string dot = std::string("dot ") + cssClass(toneOfPalpation(page.assessment));
    html.element("a",
                 {{"href", "#trial-" + number},
                  {"class", dot},
                  {"title", palpationVerdict(page.assessment)}},
                 "Trial " + number);
  }
}

void writePalpationHeader(Html& html, const PalpationReport& report) {
  const auto header = html.in("header");
  html.element("h1", report.title);
  writeWho(html, report.trainee, report.when, report.trials.size());
  if (isSimulatedPalpation(report)) writeSimulatedBanner(html);
  if (!report.force_note.empty()) {
    const auto note = html.in("p", {{"class", "force-note"}, {"role", "note"}});
    html.element("strong", "About the forces.");
    html.text(report.force_note);
  }
  writePalpationLinks(html, report);
}

void writePalpationFooter(Html& html, const PalpationReport& report) {
  const auto footer = html.in("footer");
  {
    const auto card = html.in("div", {{"class", "card"}});
    writePalpationGlossary(html);
  }
  writeMadeBy(html, {&report.station, &report.notes});
}

std::string palpationHtml(const PalpationReport& report) {
  Html html;
  html.raw("<!doctype html>\n");
  {
    const auto root = html.in("html", {{"lang", "en"}});
    writeHeadElement(html, report.title, report.trainee,
                     std::string(palpationStyle()) + std::string(subtaskTableStyle()));
    const auto body = html.in("body");
    writePalpationHeader(html, report);
    {
      const auto main = html.in("main");
      writePalpationTotals(html, report.trials, report.standard);
      for (const PalpationPage& page : report.trials) writePalpationSection(html, page);
      writeSubtaskSection(html, report.parts);
      writeFacts(html, "Where this task stands", report.taxonomy);
      writeFacts(html, "Station", report.station);
      writeFacts(html, "Notes", report.notes);
    }
    writePalpationFooter(html, report);
  }
  return html.str();
}

}  // namespace

void writePalpationReport(const PalpationReport& report, const std::filesystem::path& file) {
  writeWhole(file, palpationHtml(report));
}

}  // namespace palpa::report
