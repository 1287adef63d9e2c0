#include "apps/report/pulse/pulse_report.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "anatomy/base/text_forms.h"
#include "anatomy/base/whole_file.h"
#include "apps/report/plot/chart_frame.h"
#include "apps/training/trial_words.h"

namespace palpa::report {
namespace {

constexpr std::string_view kPulseStyle = R"css(
svg .grid{stroke:var(--line);stroke-width:1}
svg .equal{stroke:var(--ink);stroke-width:1.2;stroke-opacity:.75}
svg .margin{stroke:var(--ink);stroke-width:1;stroke-opacity:.5;stroke-dasharray:4 4}
svg .dot-share{fill:var(--blue);stroke:var(--card);stroke-width:2}
)css";

constexpr const char* kPulseSource =
    "Counting for 30 seconds: A. D. Hollerbach, N. V. Sneed, Heart Lung 19, 1990. A count "
    "is compared with the beats that were delivered in that time.";

bool pulseCounts(const assess::PulseTrial& trial) {
  return training::countsAsScored(trial.role, trial.outcome);
}

std::vector<assess::PulseTrial> pulsesThatCount(const std::vector<assess::PulseTrial>& trials) {
  std::vector<assess::PulseTrial> all;
  std::copy_if(trials.begin(), trials.end(), std::back_inserter(all), pulseCounts);
  return all;
}

double perMinute(int beats, const assess::PulseRules& rules) { return beats * 60 / rules.count_s; }

template <class Holds>
std::string ofAll(const std::vector<assess::PulseTrial>& trials, Holds holds) {
  return std::to_string(std::count_if(trials.begin(), trials.end(), holds)) + " of " +
         std::to_string(trials.size());
}

void writeInShort(Html& html, const PulseReport& report,
                  const std::vector<assess::PulseTrial>& trials) {
  const assess::PulseRules& rules = report.rules;
  const auto section = html.in("section", {{"class", "card"}});
  html.element("h2", "In short");
  html.element(
      "p", "Pulses found: " + ofAll(trials, [&](const auto& t) { return t.found(rules); }) +
               "; counted within " + trimmed(rules.count_within, 1) +
               " beats a minute: " + ofAll(trials, [&](const auto& t) { return t.counts(rules); }) +
               "; rhythms named right: " + ofAll(trials, [](const auto& t) { return t.told(); }) +
               '.');
  writeCountChart(html, report);
}

void writePulseHeads(Html& html, const std::vector<std::string>& names) {
  const auto head = html.in("thead");
  const auto row = html.in("tr");
  for (const std::string& name : names) html.element("th", name);
}

void cell(Html& html, bool right, const std::string& text) {
  html.element("td", {{"class", right ? "" : "wrong-word"}}, text);
}

void writePulseTrials(Html& html, const PulseReport& report) {
  const assess::PulseRules& rules = report.rules;
  const auto section = html.in("section", {{"class", "card"}});
  html.element("h2", "Every trial");
  const auto table = html.in("table", {{"class", "answers"}});
  writePulseHeads(
      html, {"Trial", "Artery",
             "Marked beside it, mm (found: up to " + trimmed(1e3 * rules.found_within_m, 1) + ')',
             "Counted a minute (right: within " + trimmed(rules.count_within, 1) + ')',
             "Delivered a minute", "Rhythm named", "It was", "Pressed up to, N", "Time, s"});
  const auto body = html.in("tbody");
  for (const assess::PulseTrial& t : report.trials) {
    const auto row = html.in("tr", {{"id", "trial-" + std::to_string(t.trial)}});
    html.element("td", std::to_string(t.trial) + (pulseCounts(t) ? "" : " (not counted)"));
    html.element("td", t.artery + ", " + fixed(1e3 * t.depth_m, 0) + " mm deep");
    cell(html, t.found(rules), t.off_m ? fixed(1e3 * *t.off_m, 1) : "not marked");
    cell(html, t.counts(rules), t.counted ? fixed(perMinute(*t.counted, rules), 0) : "no number");
    html.element("td", t.delivered ? fixed(perMinute(*t.delivered, rules), 0)
                                   : std::string("not counted to the end"));
    cell(html, t.told(), t.said ? wordsOf(*t.said) : "not named");
    html.element("td", wordsOf(t.rhythm));
    html.element("td", fixed(t.peak_N, 1) + (t.peak_N > rules.too_hard_N ? ": too hard" : ""));
    html.element("td", fixed(t.seconds, 0));
  }
}

/// Line by line over all trials, with the newest reason where something was not done.
void writePulseChecklist(Html& html, const PulseReport& report,
                         const std::vector<assess::PulseTrial>& trials) {
  const auto section = html.in("section", {{"class", "card"}});
  html.element("h2", "What a good examiner does");
  const auto table = html.in("table", {{"class", "answers"}});
  writePulseHeads(html, {"", "Done", "Why not, the last time"});
  const auto body = html.in("tbody");
  std::vector<std::vector<assess::PulseItem>> all;
  for (const assess::PulseTrial& trial : trials) all.push_back(pulseChecklist(trial, report.rules));
  for (std::size_t line = 0; !all.empty() && line < all.front().size(); ++line) {
    int done = 0;
    std::string why;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const assess::PulseItem& item = all[i][line];
      done += item.done;
      if (!item.done) why = "trial " + std::to_string(trials[i].trial) + ": " + item.why;
    }
    const auto row = html.in("tr");
    html.element("td", all.front()[line].text);
    html.element("td", std::to_string(done) + " of " + std::to_string(all.size()));
    html.element("td", why);
  }
}

void writePulsePage(Html& html, const PulseReport& report) {
  html.raw("<!doctype html>\n");
  {
    const auto root = html.in("html", {{"lang", "en"}});
    writeHeadElement(html, report.title, report.trainee, kPulseStyle);
    const auto body = html.in("body");
    writeSessionHeader(
        html, report, report.trials.size(),
        isSimulated(report, report.trials, [](const auto& t) { return t.simulated; }));
    {
      const auto main = html.in("main");
      const std::vector<assess::PulseTrial> trials = pulsesThatCount(report.trials);
      if (trials.empty())
        html.element("p", "No trial counts: none was both scored and finished.");
      else
        writeInShort(html, report, trials);
      writePulseTrials(html, report);
      if (!trials.empty()) writePulseChecklist(html, report, trials);
      if (!report.pictures.empty()) {
        const auto section = html.in("section", {{"class", "card"}});
        writePictures(html, report.pictures, PicturesOf::session);
      }
      writeSessionEnd(html, report);
    }
    const auto footer = html.in("footer");
    html.element("p", {{"class", "muted"}}, kPulseSource);
    writeMadeBy(html, {&report.station, &report.notes});
  }
  html.passOn();
}

constexpr double kCountTop = 16, kCountHigh = 220, kCountDot = 5;  // px
constexpr double kSlowest = 30, kFastest = 180, kCountGrid = 30;   // beats a minute

void drawCounts(Html& html, const PulseReport& report, const std::vector<assess::PulseTrial>& shown,
                const ChartFrame& frame) {
  const auto svg =
      openSvg(html, frame, kCountTop + kCountHigh + 40, "Beats a minute, counted over delivered");
  const double left = frame.left, right = frame.width - frame.right;
  const Axis x{kSlowest, kFastest, left, right},
      y{kSlowest, kFastest, kCountTop + kCountHigh, kCountTop};
  for (double rate = kSlowest; rate <= kFastest; rate += kCountGrid) {
    svgLine(html, "grid", left, y.at(rate), right, y.at(rate));
    svgText(html, "words end", left - 8, y.at(rate) + 4, fixed(rate, 0));
    svgText(html, "words mid", x.at(rate), y.from_px + 18, fixed(rate, 0));
  }
  const double margin = report.rules.count_within;
  svgLine(html, "equal", x.at(kSlowest), y.at(kSlowest), x.at(kFastest), y.at(kFastest));
  svgLine(html, "margin", x.at(kSlowest), y.at(kSlowest + margin), x.at(kFastest - margin),
          y.at(kFastest));
  svgLine(html, "margin", x.at(kSlowest + margin), y.at(kSlowest), x.at(kFastest),
          y.at(kFastest - margin));
  for (const assess::PulseTrial& t : shown) {
    const auto place = [&](const Axis& axis, int beats) {
      return coordinate(axis.at(std::clamp(perMinute(beats, report.rules), kSlowest, kFastest)));
    };
    html.empty("circle", {{"class", "dot-share"},
                          {"cx", place(x, *t.delivered)},
                          {"cy", place(y, *t.counted)},
                          {"r", coordinate(kCountDot)}});
  }
}

}  // namespace

void writePulseReport(const PulseReport& report, const std::filesystem::path& file) {
  WholeFile whole(file);
  Html html(whole);
  writePulsePage(html, report);
  whole.finish();
}

void writeCountChart(Html& html, const PulseReport& report) {
  std::vector<assess::PulseTrial> shown;
  for (const assess::PulseTrial& trial : pulsesThatCount(report.trials))
    if (trial.delivered && trial.counted) shown.push_back(trial);
  if (shown.empty()) return;
  const auto figure = html.in("figure", {{"class", "course"}});
  drawCounts(html, report, shown, kWide);
  drawCounts(html, report, shown, kNarrow);
  html.element("figcaption",
               "Beats a minute as they were counted (up) over those delivered (to the right), "
               "one dot for each trial. On the line both are equal; between the dotted lines the "
               "count is right.");
}

void writePulseCsv(const std::string& user_id, const std::vector<assess::PulseTrial>& trials,
                   const assess::PulseRules& rules, const std::filesystem::path& file) {
  const auto number = [](const auto& value) {
    return value ? shortest(static_cast<double>(*value)) : std::string();
  };
  std::string csv =
      "USER_ID,TRIAL,SEED,SIMULATED,FF,OUTCOME,ARTERY,DEPTH_MM,RHYTHM,SAID,RIGHT,FOUND,OFF_MM,"
      "FIND_S,DELIVERED,COUNTED,ERROR_PER_MIN,RHYTHM_TOLD,SHUT_PCT,PEAK_N,TIME_S\n";
  for (const assess::PulseTrial& t : pulsesThatCount(trials)) {
    csv += csvField(user_id) + ',' + std::to_string(t.trial) + ',' + std::to_string(t.seed) +
           (t.simulated ? ",1" : ",0") + (t.force_feedback ? ",1," : ",0,") +
           csvField(training::nameOf(t.outcome)) + ',' + csvField(t.artery) + ',' +
           shortest(1e3 * t.depth_m) + ',' + assess::nameOf(t.rhythm) + ',' +
           (t.said ? assess::nameOf(*t.said) : std::string()) + (t.right(rules) ? ",1" : ",0") +
           (t.found(rules) ? ",1," : ",0,") + (t.off_m ? shortest(1e3 * *t.off_m) : std::string()) +
           ',' + number(t.found_s) + ',' + number(t.delivered) + ',' + number(t.counted) + ',' +
           number(t.countError(rules)) + (t.told() ? ",1," : ",0,") +
           (t.delivered ? shortest(t.shut_pct) : std::string()) + ',' + shortest(t.peak_N) + ',' +
           shortest(t.seconds) + '\n';
  }
  writeWhole(file, csv);
}

}  // namespace palpa::report
