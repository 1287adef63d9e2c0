#include "apps/report/session_report.h"

#include <algorithm>
#include <cctype>

#include "apps/report/glossary.h"
#include "apps/report/html.h"
#include "apps/report/overview.h"
#include "apps/report/style.h"
#include "apps/report/trial_section.h"
#include "apps/report/verdict.h"
#include "anatomy/geometry/whole_file.h"

namespace palpa::report {
namespace {

bool isSimulated(const SessionReport& report) {
  return report.simulated || std::any_of(report.trials.begin(), report.trials.end(),
                                         [](const auto& t) { return t.assessment.simulated; });
}

void writeHeadElement(Html& html, const SessionReport& report) {
  const auto head = html.in("head");
  html.empty("meta", {{"charset", "utf-8"}});
  html.empty("meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}});
  html.empty("meta", {{"name", "color-scheme"}, {"content", "light dark"}});
  html.element("title", report.title + (report.trainee.empty() ? "" : " · " + report.trainee));
  const auto style = html.in("style");
  html.raw(styleSheet());
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
  {
    const auto who = html.in("p", {{"class", "who"}});
    const auto item = [&](const char* name, const std::string& value) {
      if (value.empty()) return;
      const auto span = html.in("span");
      html.text(std::string(name) + ' ');
      html.element("strong", value);
    };
    item("Trainee", report.trainee);
    item("Date", report.when);
    item("Trials", std::to_string(report.trials.size()));
  }
  if (isSimulated(report)) {
    const auto banner = html.in("p", {{"class", "banner"}, {"role", "note"}});
    html.element("strong", "SIMULATED");
    html.text("The operator or the bench is simulated. These results say nothing about a person.");
  }
  writeLinks(html, report);
}

void writeFacts(Html& html, const char* title, const std::vector<Fact>& facts) {
  if (facts.empty()) return;
  const auto section = html.in("section", {{"class", "card"}});
  html.element("h2", title);
  const auto table = html.in("table", {{"class", "facts"}});
  const auto body = html.in("tbody");
  for (const Fact& fact : facts) {
    const auto row = html.in("tr");
    html.element("th", {{"scope", "row"}}, fact.name);
    html.element("td", {{"class", "value"}}, fact.value);
    html.element("td", {{"class", "muted"}}, fact.remark);
  }
}

/// A fact named "software" or "software version", in whatever group it stands.
std::string softwareOf(const SessionReport& report) {
  for (const auto* facts : {&report.station, &report.notes, &report.registration}) {
    for (const Fact& fact : *facts) {
      std::string name = fact.name;
      std::transform(name.begin(), name.end(), name.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      if (name == "software" || name == "software version") return fact.value;
    }
  }
  return "";
}

void writeFooter(Html& html, const SessionReport& report) {
  const auto footer = html.in("footer");
  {
    const auto card = html.in("div", {{"class", "card"}});
    writeGlossary(html);
  }
  const std::string software = softwareOf(report);
  if (!software.empty()) html.element("p", {{"class", "muted small"}}, "Made by " + software + ".");
}

std::string page(const SessionReport& report) {
  Html html;
  html.raw("<!doctype html>\n");
  {
    const auto root = html.in("html", {{"lang", "en"}});
    writeHeadElement(html, report);
    const auto body = html.in("body");
    writeHeader(html, report);
    {
      const auto main = html.in("main");
      for (const TrialPage& trial : report.trials) writeTrialSection(html, trial);
      writeOverview(html, report.trials);
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
