#include "apps/calibrate/subtask_page.h"

#include <algorithm>

#include "apps/calibrate/page.h"
#include "apps/calibrate/subtask_result.h"
#include "apps/report/page/page_parts.h"

namespace palpa::calibrate {
namespace {

using report::fixed;
using report::Html;

constexpr std::size_t kShownTrials = 4;
const std::string kMostlyHead = "mostly", kGoesHead = "goes with";

void writeSentences(Html& html, const Sentences& sentences) {
  for (const std::string& sentence : sentences) html.element("p", sentence);
}

void writeHeads(Html& html, const std::vector<std::string>& heads) {
  const auto head = html.in("thead");
  const auto row = html.in("tr");
  bool first = true;
  for (const std::string& one : heads) {
    html.element("th",
                 {{"scope", "col"},
                  {"class", first || one == kMostlyHead || one == kGoesHead ? "name" : ""}},
                 one);
    first = false;
  }
}

void writeLooks(Html& html, const SubtaskRecordings& recordings, const SubtaskSegmentation& found) {
  const auto scroll = html.in("div", {{"class", "scroll"}, {"tabindex", "0"}});
  const auto table = html.in("table", {{"class", "all states"}});
  writeHeads(html, {"State", "of the time", "held for", "speed", "force", "in contact", "shaking",
                    kMostlyHead, kGoesHead});
  const auto body = html.in("tbody");
  for (std::size_t row = 0; row < found.looks.size(); ++row) {
    const StateLook& look = found.looks[row];
    const auto tr = html.in("tr");
    html.element("th", {{"scope", "row"}, {"class", "name"}}, "State " + stateName(found, row));
    const std::string part = partOf(recordings, found, row);
    for (const std::string& cell :
         {fixed(100 * look.share, 0) + " %", fixed(look.held_s, 2) + " s",
          fixed(1e3 * look.speed, 1) + " mm/s", fixed(look.force, 2) + " N",
          fixed(100 * look.contact, 0) + " %", fixed(look.shaking, 3) + " N"})
      html.element("td", cell);
    html.element(
        "td", {{"class", "name"}},
        recordings.wordsOf(look.mostly) + " (" + fixed(100 * look.mostly_share, 0) + " %)");
    html.element("td", {{"class", "name"}}, part.empty() ? "–" : part);
  }
}

void writeAgreement(Html& html, const SubtaskSegmentation& found) {
  const SubtaskAgreement& a = found.agreement;
  const auto table = html.in("table", {{"class", "facts"}});
  const auto body = html.in("tbody");
  writeFact(html, "Cohen's kappa", fixed(a.kappa, 2),
            "after the best matching; by chance " + fixed(found.by_chance.kappa, 2) +
                ". Below 0.4: little agreement");
  writeFact(html, "Adjusted Rand index", fixed(a.rand, 2),
            "without matching; by chance " + fixed(found.by_chance.rand, 2));
  writeFact(html, "Boundaries: precision", fixed(a.boundaries.precision(), 2),
            std::to_string(a.boundaries.met) + " of " + std::to_string(a.boundaries.found) +
                " proposed changes lie within 100 ms of a hand-written one");
  writeFact(html, "Boundaries: recall", fixed(a.boundaries.recall(), 2),
            std::to_string(a.boundaries.met) + " of " + std::to_string(a.boundaries.expected) +
                " hand-written changes lie within 100 ms of a proposed one");
  writeFact(html, "Boundaries: F", fixed(a.boundaries.f(), 2),
            "both in one; by chance " + fixed(found.by_chance.boundary_f, 2));
}

void writeSteps(Html& html, const SubtaskRecordings& recordings, const SubtaskSegmentation& found) {
  const auto scroll = html.in("div", {{"class", "scroll"}, {"tabindex", "0"}});
  const auto table = html.in("table", {{"class", "all states"}});
  std::vector<std::string> heads{"Seconds in"};
  for (const int label : found.steps.other) heads.push_back(recordings.wordsOf(label));
  writeHeads(html, heads);
  const auto body = html.in("tbody");
  for (std::size_t row = 0; row < found.steps.one.size(); ++row) {
    const auto tr = html.in("tr");
    html.element("th", {{"scope", "row"}, {"class", "name"}}, "State " + stateName(found, row));
    for (std::size_t c = 0; c < found.steps.other.size(); ++c)
      html.element("td", {{"class", found.matching[row] == static_cast<int>(c) ? "mine" : ""}},
                   fixed(0.01 * found.steps.counts(static_cast<Eigen::Index>(row),
                                                   static_cast<Eigen::Index>(c)),
                         1));
  }
}

void writeMain(Html& html, const SubtaskRecordings& recordings, const SubtaskSegmentation& found,
               const Result& result) {
  {
    const auto section = html.in("section", {{"class", "card"}});
    html.element("h2", "What is proposed");
    writeSentences(html, howMany(recordings, found));
    drawStatesCurve(html, found);
    html.element("h3", "What each state is like");
    writeLooks(html, recordings, found);
    html.element(
        "p", {{"class", "muted small"}},
        "Medians over the state's steps of 10 ms. Shaking: root mean square of the contact force "
        "above 20 Hz. Speeds below 1 mm/s, forces below 0.02 N and shaking below "
        "0.005 N are taken as these. Mostly: the parts that are on for most of its steps. Goes "
        "with: one to one, so that most steps agree; none where it is less than a quarter of the "
        "state.");
  }
  {
    const auto section = html.in("section", {{"class", "card"}});
    html.element("h2", "Beside the hand-written parts");
    writeSentences(html, howTheyAgree(recordings, found));
    writeAgreement(html, found);
    html.element("h3", "Where they differ");
    writeSentences(html, whereTheyDiffer(recordings, found));
    writeSteps(html, recordings, found);
    html.element(
        "p", {{"class", "muted small"}},
        "Framed: what kappa counts as agreement, one to one so that it is most. By chance: what "
        "parts as long but at other times within their trials reach 1 time in 20.");
  }
  {
    const auto section = html.in("section", {{"class", "card"}});
    const std::size_t shown = std::min(kShownTrials, recordings.sequences.size());
    html.element("h2", shown < recordings.sequences.size()
                           ? "The first " + std::to_string(shown) + " trials over time"
                           : "The trials over time");
    for (std::size_t i = 0; i < shown; ++i) drawTrialStrip(html, recordings, found, i);
  }
  const auto section = html.in("section", {{"class", "card"}});
  html.element("h2", "To be kept in mind");
  writeSentences(html, result.advice);
  std::string files;
  for (const auto& file : result.file.data.files)
    files += (files.empty() ? "" : ", ") + file.name + " (" + file.sha256.substr(0, 8) + ")";
  html.element("p", {{"class", "muted small"}},
               std::to_string(result.file.data.used) + " of " +
                   std::to_string(result.file.data.samples) + " steps were fitted to, every " +
                   std::to_string(10 * found.thinned_to) +
                   " ms; all are segmented. From: " + files + ". Made by: " + result.file.made_by);
}

}  // namespace

void writeSubtaskPage(const SubtaskRecordings& recordings, const SubtaskSegmentation& found,
                      const Result& result, const std::filesystem::path& file) {
  PageFrame frame{result.title,
                  result.title,
                  {{"Station", recordings.station},
                   {"Date", result.file.date},
                   {"Trials", std::to_string(recordings.sequences.size())}},
                  "",
                  subtaskChartStyle()};
  if (recordings.simulated)
    frame.simulated =
        "Recorded from simulated hands: it says how the program's own hands move, nothing about "
        "people.";
  writeFramed(
      frame, [](Html&) {}, [&](Html& html) { writeMain(html, recordings, found, result); }, file);
}

}  // namespace palpa::calibrate
