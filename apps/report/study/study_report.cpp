#include "apps/report/study/study_report.h"

#include <algorithm>

#include "anatomy/base/whole_file.h"
#include "apps/report/page/html.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/study/study_exhibits.h"

namespace palpa::report {
namespace {

using study_analysis::Exhibit;
using study_analysis::ExhibitPart;
using study_analysis::StudyResult;

constexpr std::size_t kStudyRowsOpen = 8;  // longer tables behind a figure are folded up

constexpr std::string_view kStudyStyle = R"css(
.findings{margin:0;padding-left:1.3rem}
.findings li{margin:0 0 .55rem;padding-left:.2rem}
.exhibit{margin:0 0 2.2rem}
.exhibit:last-child{margin-bottom:0}
.exhibit h3{margin-top:0}
.exhibit figure+figure{margin-top:1.2rem}
.study-table{border-collapse:collapse;font-size:.85rem;width:100%;margin:.6rem 0}
.study-table th,.study-table td{text-align:right;padding:.35rem .35rem;border-bottom:1px solid var(--line);white-space:nowrap}
.study-table thead th{font-weight:400;color:var(--muted);vertical-align:bottom;white-space:normal;line-height:1.25}
.study-table .words{text-align:left;white-space:normal;min-width:4.6rem}
.study-table th:first-child,.study-table td:first-child{padding-left:0}
.doubts{margin:.4rem 0 0;padding-left:1.2rem;color:var(--muted);font-size:.875rem}
details summary{cursor:pointer;color:var(--muted);font-size:.875rem;margin-top:.5rem}
.published{border-left:6px solid var(--guide)}
@media print{.study-table{font-size:7pt}.study-table th,.study-table td{padding:.2rem;white-space:normal}.study-table .words{min-width:0}.exhibit{break-inside:avoid}details summary{display:none}details::details-content{content-visibility:visible;display:block}}
)css";

/// No line ends between a number and its "%".
std::string keptTogether(std::string text) {
  for (std::size_t at = text.find(" %"); at != std::string::npos; at = text.find(" %", at + 2))
    text.replace(at, 1, "\u00a0");
  return text;
}

void writeSentences(Html& html, const char* css, const std::vector<std::string>& sentences) {
  if (sentences.empty()) return;
  const auto list = html.in("ul", {{"class", css}});
  for (const std::string& sentence : sentences) html.element("li", keptTogether(sentence));
}

void writeStudyHeader(Html& html, const StudyResult& result) {
  const auto header = html.in("header");
  html.element("h1", result.title);
  {
    const auto who = html.in("p", {{"class", "who"}});
    const auto item = [&](const char* name, const std::string& value) {
      const auto span = html.in("span");
      html.text(std::string(name) + ' ');
      html.element("strong", value);
    };
    item("Analysis", result.kind);
    item("Subjects", std::to_string(result.subjects));
    item("Trials", std::to_string(result.trials));
  }
  if (result.simulated_trials == 0) return;
  writeSimulatedBanner(html);
  if (result.simulated_trials < result.trials)
    html.element("p", {{"class", "small"}},
                 std::to_string(result.simulated_trials) + " of the " +
                     std::to_string(result.trials) + " trials are simulated.");
}

bool hidden(const study_analysis::Table& table) {
  return std::any_of(table.columns.begin(), table.columns.end(),
                     [](const study_analysis::Column& c) { return !c.page; });
}

void writeExhibitTable(Html& html, const Exhibit& exhibit) {
  if (exhibit.table.rows.empty()) return;
  if (exhibit.plots.empty() || exhibit.table.rows.size() <= kStudyRowsOpen) {
    writeStudyTable(html, exhibit.table);
    return;
  }
  const auto details = html.in("details");
  html.element("summary", "The numbers behind (" + std::to_string(exhibit.table.rows.size()) +
                              " rows; also in " + exhibit.id + ".csv)");
  writeStudyTable(html, exhibit.table);
}

void writeExhibit(Html& html, const Exhibit& exhibit, bool simulated) {
  const auto part = html.in("div", {{"class", "exhibit"}, {"id", exhibit.id}});
  html.element("h3", exhibit.title + (simulated ? " (simulated)" : ""));
  for (const study_analysis::Plot& plot : exhibit.plots) {
    const auto figure = html.in("figure", {{"class", "course"}});
    writeStudyPlot(html, plot, exhibit.title);
  }
  html.element("p", {{"class", "muted small"}},
               keptTogether(exhibit.caption) +
                   (hidden(exhibit.table) ? " More columns are in " + exhibit.id + ".csv." : ""));
  writeExhibitTable(html, exhibit);
  writeSentences(html, "doubts", exhibit.notes);
}

void writeParts(Html& html, const StudyResult& result, ExhibitPart part, const char* title,
                const char* css, const std::vector<std::string>& words) {
  bool some = !words.empty();
  for (const Exhibit& e : result.exhibits) some = some || e.part == part;
  if (!some) return;
  const auto section = html.in("section", {{"class", css}});
  html.element("h2", title);
  for (const std::string& sentence : words) html.element("p", sentence);
  for (const Exhibit& e : result.exhibits)
    if (e.part == part) writeExhibit(html, e, result.simulated_trials > 0);
}

void writeStudyMain(Html& html, const StudyPage& page) {
  const auto main = html.in("main");
  const StudyResult& result = page.result;
  {
    const auto section = html.in("section", {{"class", "card"}});
    html.element("h2",
                 result.simulated_trials > 0 ? "What was found (simulated)" : "What was found");
    writeSentences(html, "findings", result.findings);
  }
  {
    const auto section = html.in("section", {{"class", "card"}});
    html.element("h2", "What cannot be said");
    writeSentences(html, "findings", result.cautions);
  }
  writeParts(html, result, ExhibitPart::figure, "Figures", "card", {});
  writeParts(html, result, ExhibitPart::table, "Tables and tests", "card", {});
  writeParts(html, result, ExhibitPart::check, "A second look at the same trials", "card", {});
  writeParts(html, result, ExhibitPart::published, "As published", "card published",
             result.published_words);
  std::vector<Fact> facts = page.sources;
  for (const std::string& software : result.software)
    facts.push_back({"Recorded by", software, ""});
  writeFacts(html, "Where this comes from", facts);
}

std::string studyHtml(const StudyPage& page) {
  Html html;
  html.raw("<!doctype html>\n");
  {
    const auto root = html.in("html", {{"lang", "en"}});
    writeHeadElement(html, page.result.title, "",
                     std::string(kStudyStyle) + std::string(studyChartStyle()));
    const auto body = html.in("body");
    writeStudyHeader(html, page.result);
    writeStudyMain(html, page);
  }
  return html.page();
}

}  // namespace

void writeStudyReport(const StudyPage& page, const std::filesystem::path& file) {
  writeWhole(file, studyHtml(page));
}

std::vector<std::filesystem::path> writeStudyTables(const StudyResult& result,
                                                    const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const Exhibit& e : result.exhibits) {
    const bool simulated = result.simulated_trials > 0;
    files.push_back(folder / (e.id + ".csv"));
    writeWhole(files.back(), studyCsv(e.table, simulated));
    files.push_back(folder / (e.id + ".json"));
    writeWhole(files.back(), studyJson(e, simulated));
  }
  return files;
}

}  // namespace palpa::report
