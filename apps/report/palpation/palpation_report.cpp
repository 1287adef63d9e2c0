#include "apps/report/palpation/palpation_report.h"

#include <algorithm>
#include <string>

#include "anatomy/base/text_forms.h"
#include "anatomy/base/whole_file.h"
#include "apps/report/page/html.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/page/subtask_table.h"
#include "apps/report/palpation/palpation_sections.h"
#include "apps/training/trial_words.h"

namespace palpa::report {
namespace {

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
  const bool simulated = isSimulated(report, report.trials, [](const PalpationPage& page) {
    return page.assessment.facts.simulated;
  });
  writeSessionHeader(html, report, report.trials.size(), simulated, [&] {
    if (!report.force_note.empty()) {
      const auto note = html.in("p", {{"class", "force-note"}, {"role", "note"}});
      html.element("strong", "About the forces.");
      html.text(report.force_note);
    }
    writePalpationLinks(html, report);
  });
}

void writePalpationFooter(Html& html, const PalpationReport& report) {
  const auto footer = html.in("footer");
  writeMadeBy(html, {&report.station, &report.notes});
}

void writePalpations(Html& html, const PalpationReport& report) {
  eachPage(
      report.trials, report.courses,
      [](const PalpationPage& page) { return page.assessment.facts.trial; },
      [&](const PalpationPage& page) {
        writePalpationSection(html, page);
        html.passOn();
      });
}

void writePalpationPage(Html& html, const PalpationReport& report) {
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
      writePalpations(html, report);
      if (report.parts.augmented) writeSubtaskSection(html, report.parts);
      writeSessionEnd(
          html, report,
          [&] {
            if (!report.parts.augmented) writeSubtaskSection(html, report.parts);
          },
          [&] { writePalpationGlossary(html); });
    }
    writePalpationFooter(html, report);
  }
  html.passOn();
}

}  // namespace

void writePalpationReport(const PalpationReport& report, const std::filesystem::path& file) {
  WholeFile whole(file);
  Html html(whole);
  writePalpationPage(html, report);
  whole.finish();
}

namespace {

constexpr const char* kPalpationHeader =
    "USER_ID,TRIAL,SEED,SIMULATED,FF,OUTCOME,LUMPS,FOUND,MISSED,FALSE_ALARMS,REPEATED,CLEAR_"
    "QUADRANTS,WRONG_QUADRANTS,ILL_QUADRANTS,HIT_QUADRANTS,COVERAGE_LIGHT,COVERAGE_MEDIUM,COVERAGE_"
    "DEEP,TWICE,"
    "PATTERN,PATTERN_KEPT,PEAK_N,MEAN_N,TOO_LIGHT,TOO_HARD,CLOSER_FORCE,PRESSES,TIME_S,GUIDED,"
    "ERROR_MEAN_MM,SIZE_ERROR_MEAN_MM,AT_STANDARD,AUGMENTED";

std::string meanField(double sum, int count) { return count > 0 ? shortest(sum / count) : ""; }

/// ERROR_MEAN_MM and SIZE_ERROR_MEAN_MM.
std::string errorFields(const assess::PalpationAssessment& trial) {
  double error = 0, size = 0;
  int found = 0, graded = 0;
  for (const assess::LumpVerdict& verdict : trial.score.lumps) {
    if (verdict.mark < 0) continue;
    error += 1000 * verdict.error;
    ++found;
    if (!(trial.marks.at(static_cast<std::size_t>(verdict.mark)).diameter > 0)) continue;
    size += 1000 * verdict.size_error;
    ++graded;
  }
  return meanField(error, found) + ',' + meanField(size, graded);
}

std::string palpationRow(const std::string& user_id, const assess::PalpationAssessment& trial) {
  const assess::PalpationFacts& facts = trial.facts;
  const assess::PalpationScore& s = trial.score;
  std::string line = csvField(user_id) + ',' + std::to_string(facts.trial) + ',' +
                     std::to_string(facts.seed) + (facts.simulated ? ",1" : ",0") +
                     (facts.force_feedback ? ",1," : ",0,") +
                     csvField(training::nameOf(facts.outcome));
  for (const int count : {s.found + s.missed, s.found, s.missed, s.false_alarms, s.repeated,
                          s.clear_quadrants, s.wrong_quadrants, s.ill_quadrants, s.hit_quadrants})
    line += ',' + std::to_string(count);
  for (const double share : s.coverage) line += ',' + shortest(share);
  line += ',' + shortest(s.twice) + ',' + assess::nameOf(s.pattern.pattern);
  for (const double value : {s.pattern.kept, s.peak, s.mean, s.too_light, s.too_hard})
    line += ',' + shortest(value);
  line +=
      ',' + (s.closer_force > 0 ? shortest(s.closer_force) : "") + ',' + std::to_string(s.presses);
  return line + ',' + shortest(s.seconds) + ',' + shortest(facts.guided) + ',' +
         errorFields(trial) + (trial.passed ? ",1" : ",0") + (facts.augmented ? ",1" : ",0");
}

}  // namespace

void writePalpationCsv(const std::string& user_id,
                       const std::vector<assess::PalpationAssessment>& trials,
                       const std::filesystem::path& file,
                       const std::vector<assess::SubtaskDose>& parts_of_none) {
  const std::vector<assess::SubtaskDose>& parts =
      trials.empty() ? parts_of_none : trials.front().doses;
  std::string csv = kPalpationHeader + subtaskColumns(parts) + '\n';
  for (const auto& trial : trials)
    csv += palpationRow(user_id, trial) + subtaskFields(parts, trial.doses) + '\n';
  writeWhole(file, csv);
}

namespace {

/// Levels: one hue in four steps, and pips to count. Rings and crosses stand on a halo, so that
/// they are seen on every step.
constexpr std::string_view kPalpationStyle = R"css(
.force-note{margin:1.1rem 0 0;padding:.7rem 1rem;border-left:6px solid var(--blue);border-radius:8px;background:var(--card)}
.force-note strong{margin-right:.6rem}
.advice{margin:0;padding-left:1.5rem}
.advice li{margin:0 0 .5rem;padding-left:.2rem}
.lumps{border-collapse:collapse;width:100%;font-size:.9rem;margin:0 0 1rem}
.lumps th,.lumps td{text-align:left;vertical-align:top;padding:.45rem .9rem .45rem 0;border-bottom:1px solid var(--line)}
.lumps th{font-weight:600}
.lumps td:nth-child(3){white-space:nowrap}
.lumps thead th{font-weight:400;color:var(--muted)}
.missed-word{color:var(--bad-ink);font-weight:600}
svg .cell{stroke:var(--line);stroke-width:1}
svg .cell.level-0{fill:var(--card)}
svg .cell.level-1{fill:color-mix(in srgb,var(--blue) 18%,var(--card))}
svg .cell.level-2{fill:color-mix(in srgb,var(--blue) 42%,var(--card))}
svg .cell.level-3{fill:color-mix(in srgb,var(--blue) 78%,var(--card))}
svg .pips{fill:none;stroke:var(--ink);stroke-width:3;stroke-linecap:round}
svg .pips.level-3{stroke:var(--on)}
svg .contour{fill:none;stroke:var(--ink);stroke-width:1;stroke-opacity:.45}
svg .edge{fill:none;stroke:var(--muted);stroke-width:1.5}
svg .halo{fill:none;stroke:var(--card);stroke-width:7;stroke-linecap:round}
svg .normal{fill:none;stroke:var(--muted);stroke-opacity:.55;stroke-linecap:round;stroke-linejoin:round}
svg .normal-line{fill:none;stroke:var(--ink);stroke-width:1.5;stroke-dasharray:2 5;stroke-linecap:round}
svg .ring{fill:none;stroke-width:3.5}
svg .ring.found{stroke:var(--good-ink)}
svg .ring.missed{stroke:var(--bad-ink);stroke-dasharray:8 6}
svg .cross{fill:none;stroke:var(--ink);stroke-width:3;stroke-linecap:round}
svg .cross.alarm{stroke:var(--bad-ink);stroke-linejoin:round}
svg .bar-10mm{fill:none;stroke:var(--ink);stroke-width:3}
svg .curve.pressing{stroke:var(--blue)}
svg .curve.beside{stroke:var(--guide);stroke-dasharray:9 3 2 3}
svg .area.pressing{fill:var(--blue)}
svg .threshold{stroke:var(--ink);stroke-width:1.2;stroke-opacity:.75}
svg .threshold.level-1{stroke-dasharray:1 4}
svg .threshold.level-2{stroke-dasharray:4 4}
svg .threshold.level-3{stroke-dasharray:10 4}
svg .threshold.hard{stroke:var(--bad-ink);stroke-width:1.8;stroke-opacity:1}
)css";

}  // namespace

std::string_view palpationStyle() { return kPalpationStyle; }

}  // namespace palpa::report
