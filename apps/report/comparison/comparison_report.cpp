#include "apps/report/comparison/comparison_report.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "anatomy/base/text_forms.h"
#include "anatomy/base/whole_file.h"
#include "apps/assess/comparison/comparison_trial.h"
#include "apps/assess/statistics/sample.h"
#include "apps/report/page/html.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/plot/chart_frame.h"
#include "apps/training/trial_words.h"

namespace palpa::report {
namespace {

using assess::ComparedProperty;

constexpr std::string_view kComparisonStyle = R"css(
svg .grid{stroke:var(--line);stroke-width:1}
svg .whisker{stroke:var(--ink);stroke-width:2;stroke-linecap:round}
svg .dot-share{fill:var(--blue);stroke:var(--card);stroke-width:2}
svg .threshold{stroke:var(--ink);stroke-width:1.2;stroke-opacity:.75}
svg .threshold.level-2{stroke-dasharray:4 4}
)css";

constexpr const char* kShareSource =
    "Shares of right answers: E. B. Wilson, J. Am. Stat. Assoc. 22, 1927. The just noticeable "
    "difference: D. M. Green, J. A. Swets, Signal Detection Theory and Psychophysics, 1966; its "
    "interval: S. S. Wilks, Ann. Math. Stat. 9, 1938.";
constexpr const char* kSortingSource =
    "How near an order is to the true one: M. G. Kendall, A new measure of rank correlation, "
    "Biometrika 30, 1938.";

bool countsIn(const assess::ComparisonTrial& trial) {
  return training::countsAsScored(trial.role, trial.outcome);
}

std::vector<assess::ComparisonTrial> thatCount(const std::vector<assess::ComparisonTrial>& trials) {
  std::vector<assess::ComparisonTrial> all;
  std::copy_if(trials.begin(), trials.end(), std::back_inserter(all), countsIn);
  return all;
}

/// "Three of four answers are right from a difference of 21 % on (95 %: 14 % to 44 %)."
std::string thresholdSentence(const assess::Discrimination& answers) {
  if (answers.of == 0) return "";
  if (answers.right == answers.of)
    return "All answers were right: what is just noticeable is smaller than these differences, or "
           "too few were asked.";
  if (!answers.threshold)
    return "These answers do not tell what is just noticeable: too few, or no better than chance.";
  const assess::Threshold& t = *answers.threshold;
  if (const double asked = answers.shares.back().ratio; t.ratio > asked * asked)
    return "Three of four answers would be right only from a difference well above those asked" +
           (t.low ? ": " + percentMore(*t.low) + " or more (95 %)." : std::string("."));
  return "Three of four answers are right from a difference of about " + percentMore(t.ratio) +
         " on (95 % interval: " + (t.low ? percentMore(*t.low) : std::string("from nothing")) +
         " to " + (t.high ? percentMore(*t.high) : std::string("no limit")) + ").";
}

void writeProperty(Html& html, const std::vector<assess::ComparisonTrial>& trials,
                   ComparedProperty property) {
  const assess::Discrimination answers = assess::discriminationIn(trials, property);
  if (answers.of == 0) return;
  const auto section = html.in("section", {{"class", "card"}});
  html.element("h2", std::string("Which one is ") + assess::moreOf(property) + "?");
  html.element("p", "Answers right: " + std::to_string(answers.right) + " of " +
                        std::to_string(answers.of) + ". " + thresholdSentence(answers));
  writeComparisonChart(html, answers, assess::moreOf(property));
}

bool isFriction(const std::vector<assess::ComparisonTrial>& trials) {
  return !trials.empty() && trials.front().property == ComparedProperty::friction;
}
bool isSorting(const std::vector<assess::ComparisonTrial>& trials) {
  return !trials.empty() && trials.front().sorting();
}

std::string numberText(const assess::ComparisonTrial& t) {
  return std::to_string(t.trial) + (countsIn(t) ? "" : " (not counted)");
}

void writeHeads(Html& html, const std::vector<const char*>& names) {
  const auto head = html.in("thead");
  const auto row = html.in("tr");
  for (const char* name : names) html.element("th", name);
}

constexpr char kAsItIs[] = "100 % is the thing as it is, with nothing made more or less.";

/// What every trial's row ends with.
void writeForceAndTime(Html& html, const assess::ComparisonTrial& t, double too_hard_N) {
  html.element("td", fixed(t.peak_N, 1) + " N" + (t.peak_N > too_hard_N ? ": too hard" : ""));
  html.element("td", fixed(t.seconds, 0) + " s");
}

void writeAnswers(Html& html, const ComparisonReport& report) {
  const auto section = html.in("section", {{"class", "card"}});
  html.element("h2", "Every answer");
  html.element("p", {{"class", "muted small"}}, kAsItIs);
  const auto table = html.in("table", {{"class", "answers"}});
  const bool stroked = isFriction(report.trials);
  writeHeads(html, {"Trial", "Answer", "First", "Second", stroked ? "Touches" : "Grips",
                    stroked ? "Pressed up to" : "Squeezed up to", "Time"});
  const auto body = html.in("tbody");
  for (const assess::ComparisonTrial& t : report.trials) {
    const auto row = html.in("tr", {{"id", "trial-" + std::to_string(t.trial)}});
    html.element("td", numberText(t));
    html.element("td", {{"class", t.answered() && !t.right() ? "wrong-word" : ""}}, summaryOf(t));
    for (const double factor : t.factors) html.element("td", fixed(100 * factor, 0) + " %");
    html.element("td", std::to_string(t.touches[0]) + " and " + std::to_string(t.touches[1]));
    writeForceAndTime(html, t, report.too_hard_N);
  }
}

/// "Orders right: 3 of 4. They agreed with the true ones by 0.92 on average (Kendall's tau, ...)."
std::string orderSentence(const std::vector<assess::ComparisonTrial>& trials) {
  int said = 0, right = 0;
  double sum = 0;
  for (const assess::ComparisonTrial& trial : trials) {
    const std::optional<double> tau = trial.tau();
    if (!tau) continue;
    ++said;
    right += trial.right();
    sum += *tau;
  }
  if (said == 0) return "No order was said.";
  return "Orders right: " + std::to_string(right) + " of " + std::to_string(said) +
         ". They agreed with the true ones by " + fixed(sum / said, 2) +
         " on average (Kendall's tau: 1 for the true order, 0 by chance, -1 for the reversed one).";
}

/// The true order with what each surface had: "2 (50 %), 1 (100 %)".
std::string trueOrderText(const assess::ComparisonTrial& trial) {
  std::string text;
  for (const int number : trial.trueOrder())
    text += (text.empty() ? "" : ", ") + std::to_string(number) + " (" +
            fixed(100 * trial.factors[static_cast<std::size_t>(number - 1)], 0) + " %)";
  return text;
}

void writeOrders(Html& html, const ComparisonReport& report) {
  const auto section = html.in("section", {{"class", "card"}});
  html.element("h2", "From the smoothest to the roughest");
  html.element("p", orderSentence(thatCount(report.trials)));
  html.element("p", {{"class", "muted small"}}, kAsItIs);
  const auto table = html.in("table", {{"class", "answers"}});
  writeHeads(html,
             {"Trial", "Said", "True order", "Agreement", "Touches", "Pressed up to", "Time"});
  const auto body = html.in("tbody");
  for (const assess::ComparisonTrial& t : report.trials) {
    const auto row = html.in("tr", {{"id", "trial-" + std::to_string(t.trial)}});
    const std::optional<double> tau = t.tau();
    html.element("td", numberText(t));
    html.element("td", {{"class", tau && !t.right() ? "wrong-word" : ""}},
                 tau ? assess::orderText(t.order) : summaryOf(t));
    html.element("td", trueOrderText(t));
    html.element("td", tau ? fixed(*tau, 2) : "");
    html.element("td", std::to_string(std::accumulate(t.touches.begin(), t.touches.end(), 0)));
    writeForceAndTime(html, t, report.too_hard_N);
  }
}

void writeComparisonHeader(Html& html, const ComparisonReport& report) {
  const bool simulated = isSimulated(report, report.trials,
                                     [](const assess::ComparisonTrial& t) { return t.simulated; });
  writeSessionHeader(html, report, report.trials.size(), simulated);
}

void writeComparisonPage(Html& html, const ComparisonReport& report) {
  html.raw("<!doctype html>\n");
  {
    const auto root = html.in("html", {{"lang", "en"}});
    writeHeadElement(html, report.title, report.trainee, kComparisonStyle);
    const auto body = html.in("body");
    writeComparisonHeader(html, report);
    {
      const auto main = html.in("main");
      const std::vector<assess::ComparisonTrial> trials = thatCount(report.trials);
      if (trials.empty()) html.element("p", "No trial counts: none was both scored and finished.");
      for (const ComparedProperty property :
           {ComparedProperty::stiffness, ComparedProperty::weight, ComparedProperty::friction})
        writeProperty(html, trials, property);
      if (isSorting(report.trials))
        writeOrders(html, report);
      else
        writeAnswers(html, report);
      if (!report.pictures.empty()) {
        const auto section = html.in("section", {{"class", "card"}});
        writePictures(html, report.pictures, PicturesOf::session);
      }
      writeSessionEnd(html, report);
    }
    const auto footer = html.in("footer");
    html.element("p", {{"class", "muted"}},
                 isSorting(report.trials) ? kSortingSource : kShareSource);
    writeMadeBy(html, {&report.station, &report.notes});
  }
  html.passOn();
}

}  // namespace

void writeComparisonReport(const ComparisonReport& report, const std::filesystem::path& file) {
  WholeFile whole(file);
  Html html(whole);
  writeComparisonPage(html, report);
  whole.finish();
}

namespace {

constexpr double kSharesTop = 16, kHigh = 170, kDot = 6, kWhisker = 7;  // px

void drawShares(Html& html, const assess::Discrimination& answers, const char* what,
                const ChartFrame& frame) {
  const auto svg = openSvg(html, frame, kSharesTop + kHigh + 46,
                           std::string("Share of right answers to which one was ") + what);
  const Axis y{0, 1, kSharesTop + kHigh, kSharesTop};
  const double left = frame.left, right = frame.width - frame.right,
               column = (right - left) / static_cast<double>(answers.shares.size());
  for (const double share : {0.0, 0.5, 1.0}) {
    svgLine(html, share == 0.5 ? "threshold level-2" : "grid", left, y.at(share), right,
            y.at(share));
    svgText(html, "words end", left - 8, y.at(share) + 4, fixed(100 * share, 0) + " %");
  }
  svgText(html, "words end", right, y.at(0.5) - 5, "chance");
  for (std::size_t i = 0; i < answers.shares.size(); ++i) {
    const assess::SharesAtRatio& share = answers.shares[i];
    const statistics::ShareInterval interval = statistics::wilson(share.right, share.of);
    const double x = left + (static_cast<double>(i) + 0.5) * column;
    svgLine(html, "whisker", x, y.at(interval.low), x, y.at(interval.high));
    for (const double end : {interval.low, interval.high})
      svgLine(html, "whisker", x - kWhisker, y.at(end), x + kWhisker, y.at(end));
    html.empty("circle", {{"class", "dot-share"},
                          {"cx", coordinate(x)},
                          {"cy", coordinate(y.at(interval.share))},
                          {"r", coordinate(kDot)}});
    svgText(html, "words mid", x, y.from_px + 18, percentMore(share.ratio));
    svgText(html, "words mid", x, y.from_px + 34,
            std::to_string(share.right) + " of " + std::to_string(share.of));
  }
}

}  // namespace

std::string percentMore(double ratio) { return fixed(100 * (ratio - 1), 0) + " %"; }

void writeComparisonChart(Html& html, const assess::Discrimination& answers, const char* what) {
  if (answers.shares.empty()) return;
  const auto figure = html.in("figure", {{"class", "course"}});
  drawShares(html, answers, what, kWide);
  drawShares(html, answers, what, kNarrow);
  html.element("figcaption", std::string("Share of right answers, by how much ") + what +
                                 " one of the two was. The bars are 95 % intervals (Wilson): where "
                                 "one reaches below the dotted line, it may have been chance.");
}

namespace {

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : " ") + part;
  return text;
}
template <class Values, class Text>
std::string listOf(const Values& values, Text text) {
  std::vector<std::string> parts;
  for (const auto& value : values) parts.push_back(text(value));
  return joined(parts);
}

/// FACTORS,ORDER,TRUE_ORDER,RIGHT,TAU,PEAK_N,TIME_S,TOUCHES
std::string orderColumns(const assess::ComparisonTrial& t) {
  const auto number = [](int n) { return std::to_string(n); };
  const std::optional<double> tau = t.tau();
  return listOf(t.factors, shortest) + ',' + listOf(t.order, number) + ',' +
         listOf(t.trueOrder(), number) + (t.right() ? ",1," : ",0,") +
         (tau ? shortest(*tau) : std::string()) + ',' + shortest(t.peak_N) + ',' +
         shortest(t.seconds) + ',' + listOf(t.touches, number);
}

/// FIRST,SECOND,SAID,RIGHT,PEAK_N,TIME_S and how often each was touched
std::string answerColumns(const assess::ComparisonTrial& t) {
  return shortest(t.factors[0]) + ',' + shortest(t.factors[1]) + ',' + std::to_string(t.said) +
         (t.right() ? ",1," : ",0,") + shortest(t.peak_N) + ',' + shortest(t.seconds) + ',' +
         std::to_string(t.touches[0]) + ',' + std::to_string(t.touches[1]);
}

}  // namespace

void writeComparisonCsv(const std::string& user_id,
                        const std::vector<assess::ComparisonTrial>& trials,
                        const std::filesystem::path& file) {
  const bool sorting = isSorting(trials);
  std::string csv = "USER_ID,TRIAL,SEED,SIMULATED,FF,OUTCOME,PROPERTY,";
  csv += sorting ? "FACTORS,ORDER,TRUE_ORDER,RIGHT,TAU,PEAK_N,TIME_S,TOUCHES\n"
         : isFriction(trials)
             ? "FIRST,SECOND,SAID,RIGHT,PEAK_N,TIME_S,TOUCHES_FIRST,TOUCHES_SECOND\n"
             : "FIRST,SECOND,SAID,RIGHT,PEAK_N,TIME_S,GRIPS_FIRST,GRIPS_SECOND\n";
  for (const assess::ComparisonTrial& t : thatCount(trials)) {
    csv += csvField(user_id) + ',' + std::to_string(t.trial) + ',' + std::to_string(t.seed) +
           (t.simulated ? ",1" : ",0") + (t.force_feedback ? ",1," : ",0,") +
           csvField(training::nameOf(t.outcome)) + ',' + assess::nameOf(t.property) + ',' +
           (sorting ? orderColumns(t) : answerColumns(t)) + '\n';
  }
  writeWhole(file, csv);
}

}  // namespace palpa::report
