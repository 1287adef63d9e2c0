#include "apps/report/session_report.h"

#include <algorithm>

#include "anatomy/geometry/whole_file.h"
#include "apps/report/competence_section.h"
#include "apps/report/glossary.h"
#include "apps/report/html.h"
#include "apps/report/overview.h"
#include "apps/report/page_parts.h"
#include "apps/report/trial_section.h"
#include "apps/report/verdict.h"

namespace palpa::report {
namespace {

bool isSimulated(const SessionReport& report) {
  return report.simulated || std::any_of(report.trials.begin(), report.trials.end(),
                                         [](const auto& t) { return t.assessment.simulated; });
}

bool byPath(const SessionReport& report) {
  return std::all_of(report.trials.begin(), report.trials.end(),
                     [](const auto& t) { return t.assessment.by_path; });
}

void writeLinks(Html& html, const SessionReport& report) {
  if (report.trials.size() < 2) return;
  const auto nav = html.in("nav", {{"aria-label", "Trials"}});
  for (const TrialPage& page : report.trials) {
    const std::string number = std::to_string(page.assessment.trial);
    html.element("a",
                 {{"href", "#trial-" + number},
                  {"class", std::string("dot ") + cssClass(toneOfOutcome(page.assessment))},
                  {"title", outcomeWords(page.assessment)}},
                 "Trial " + number);
  }
  html.element("a", {{"href", "#all-trials"}}, "All trials");
}

void writeHeader(Html& html, const SessionReport& report) {
  const auto header = html.in("header");
  html.element("h1", report.title);
  writeWho(html, report.trainee, report.when, report.trials.size());
  if (isSimulated(report)) writeSimulatedBanner(html);
  writeLinks(html, report);
}

void writeFooter(Html& html, const SessionReport& report) {
  const auto footer = html.in("footer");
  if (byPath(report)) {
    const auto card = html.in("div", {{"class", "card"}});
    writeGlossary(html);
  }
  writeMadeBy(html, {&report.station, &report.notes, &report.registration});
}

std::string page(const SessionReport& report) {
  Html html;
  html.raw("<!doctype html>\n");
  {
    const auto root = html.in("html", {{"lang", "en"}});
    writeHeadElement(html, report.title, report.trainee,
                     std::string(subtaskTableStyle()) + std::string(competenceStyle()));
    const auto body = html.in("body");
    writeHeader(html, report);
    {
      const auto main = html.in("main");
      for (const TrialPage& trial : report.trials) writeTrialSection(html, trial);
      writeOverview(html, report.trials);
      writeSubtaskSection(html, report.parts);
      writeFacts(html, "Where this task stands", report.taxonomy);
      writeFacts(html, "Registration", report.registration);
      writeFacts(html, "Station", report.station);
      writeFacts(html, "Notes", report.notes);
    }
    writeFooter(html, report);
  }
  return html.str();
}

}  // namespace

void writeReport(const SessionReport& report, const std::filesystem::path& file) {
  writeWhole(file, page(report));
}

}  // namespace palpa::report
