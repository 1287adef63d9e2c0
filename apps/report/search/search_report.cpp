#include "apps/report/search/search_report.h"

#include <algorithm>

#include "anatomy/base/text_forms.h"
#include "anatomy/base/whole_file.h"
#include "apps/report/page/html.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/page/subtask_table.h"
#include "apps/report/search/search_sections.h"
#include "apps/training/trial_words.h"

namespace palpa::report {
namespace {

constexpr std::string_view kSearchStyle = R"css(
svg .whisker{stroke:var(--ink);stroke-width:2;stroke-linecap:round}
svg .dot-share{fill:var(--blue);stroke:var(--card);stroke-width:2}
svg .by-chance{stroke:var(--ink);stroke-width:1.2;stroke-dasharray:4 4;stroke-opacity:.75}
svg .median{stroke:var(--ink);stroke-width:2;stroke-opacity:.55}
svg .row-back{fill:var(--lane);fill-opacity:.75}
svg .row-back.odd{fill-opacity:.35}
.findings{margin:0 0 1rem;padding-left:1.3rem}
.findings li{margin:0 0 .4rem;padding-left:.2rem}
.recovered{margin:0 0 1.2rem;padding:.7rem 1rem;border-left:6px solid var(--blue);border-radius:8px;background:color-mix(in srgb,var(--blue) 7%,var(--card))}
.episodes{border-collapse:collapse;width:100%;font-size:.9rem;margin:0 0 1rem}
.episodes th,.episodes td{text-align:right;vertical-align:middle;padding:.4rem 0 .4rem 1rem;border-bottom:1px solid var(--line);white-space:nowrap}
.episodes thead th{font-weight:400;color:var(--muted);vertical-align:bottom;white-space:normal}
.episodes th:first-child,.episodes .words,.episodes thead th:nth-child(2),.episodes thead th:nth-child(4){text-align:left}
.episodes th:first-child{padding-left:0}
.episodes td:nth-child(3),.episodes thead th:nth-child(3){text-align:center}
.aside{display:block;font-weight:400;color:var(--muted);font-size:.8rem}
.place{display:inline-block;width:48px;height:48px;vertical-align:middle}
svg .floor{fill:none;stroke:var(--line)}
svg .element{fill:none;stroke:var(--muted);stroke-width:1.2}
svg .element.target{fill:var(--ink);stroke:var(--ink)}
svg .choice{fill:none;stroke:var(--good);stroke-width:2.4}
svg .choice.other{stroke:var(--bad);stroke-dasharray:3.2 2.2}
@media print{.episodes tr{break-inside:avoid}}
)css";

void writeSearchHeader(Html& html, const SearchReport& report) {
  const bool simulated =
      isSimulated(report, report.trials, [](const assess::SearchTrial& t) { return t.simulated; });
  writeSessionHeader(html, report, report.trials.size(), simulated);
}

void writeSearchMain(Html& html, const SearchReport& report) {
  const auto main = html.in("main");
  writeSearchFindings(html, report.trials);
  writeSearchTimes(html, report.trials);
  const bool augmented =
      std::any_of(report.trials.begin(), report.trials.end(),
                  [](const auto& trial) { return trial.mode == assess::SearchMode::augmented; });
  if (augmented) writeDoses(html, report);
  writeEpisodes(html, report);
  if (report.figures) writeSearchFigures(html, *report.figures);
  if (!report.pictures.empty()) {
    const auto section = html.in("section", {{"class", "card"}});
    writePictures(html, report.pictures, PicturesOf::session);
  }
  writeSessionEnd(
      html, report,
      [&] {
        if (!augmented) writeDoses(html, report);
      },
      [&] { writeSearchGlossary(html); });
}

void writeSearchPage(Html& html, const SearchReport& report) {
  html.raw("<!doctype html>\n");
  {
    const auto root = html.in("html", {{"lang", "en"}});
    writeHeadElement(
        html, report.title, report.trainee,
        std::string(kSearchStyle) + std::string(subtaskTableStyle()) + searchFiguresStyle());
    const auto body = html.in("body");
    writeSearchHeader(html, report);
    writeSearchMain(html, report);
    const auto footer = html.in("footer");
    writeMadeBy(html, {&report.station, &report.notes});
  }
  html.passOn();
}

}  // namespace

void writeSearchReport(const SearchReport& report, const std::filesystem::path& file) {
  WholeFile whole(file);
  Html html(whole);
  writeSearchPage(html, report);
  whole.finish();
}

namespace {

std::string episodeFields(const assess::SearchTrial& t) {
  std::string row = ',' + std::to_string(t.trial) + ',' + std::to_string(t.seed) +
                    (t.simulated ? ",1" : ",0") + (t.force_feedback ? ",1," : ",0,") +
                    csvField(training::nameOf(t.outcome)) + ',' + csvField(t.block) + ',' +
                    assess::name(t.mode);
  row += ',' + shortest(t.orientation_deg) + ',' + std::to_string(t.target) + ',' +
         std::to_string(t.chosen) + (assess::chose(t) && t.found() ? ",1" : ",0");
  for (const double value : {t.seconds, t.path_m, t.mean_force_N, t.peak_force_N, t.visited_s[0],
                             t.visited_s[1], t.visited_s[2]})
    row += ',' + shortest(value);
  return row;
}

}  // namespace

void writeSearchCsv(const std::string& user_id, const std::vector<assess::SearchTrial>& trials,
                    const std::filesystem::path& file,
                    const std::vector<assess::SubtaskDose>& parts_of_none) {
  const std::vector<assess::SubtaskDose>& parts =
      trials.empty() ? parts_of_none : trials.front().doses;
  std::string csv =
      "USER_ID,TRIAL,SEED,SIMULATED,FF,OUTCOME,BLOCK,MODE,ORIENTATION_DEG,TARGET,CHOSEN,FOUND,TIME_"
      "S,PATH_M,MEAN_N,PEAK_N,VISIT_0_S,VISIT_1_S,VISIT_2_S" +
      subtaskColumns(parts) + '\n';
  for (const assess::SearchTrial& trial : trials)
    csv += csvField(user_id) + episodeFields(trial) + subtaskFields(parts, trial.doses) + '\n';
  writeWhole(file, csv);
}

}  // namespace palpa::report
