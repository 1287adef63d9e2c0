#include <algorithm>
#include <array>

#include "anatomy/base/counted.h"
#include "apps/calibrate/page.h"
#include "apps/calibrate/procedure_proposal.h"
#include "apps/calibrate/subtask_page.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/page/style.h"
#include "apps/report/plot/chart_frame.h"

namespace palpa::calibrate {
namespace {

using namespace report;

constexpr double kProcedurePitch = 17, kProcedureBar = 13, kStepWide_s = 0.010;  // px, px, s
constexpr std::size_t kStrips = 6;
constexpr double kLeastWide = 0.4;  // px: the shortest visit is seen

std::string percentOf(double share) { return fixed(100 * share, share < 0.0095 ? 1 : 0) + " %"; }

void writeHeadRow(Html& html, const std::vector<std::string>& heads) {
  const auto head = html.in("thead");
  const auto row = html.in("tr");
  for (const std::string& one : heads)
    html.element("th", {{"scope", "col"}, {"class", "name"}}, one);
}

void writeProposed(Html& html, const ProcedureProposal& p) {
  const auto scroll = html.in("div", {{"class", "scroll"}, {"tabindex", "0"}});
  const auto table = html.in("table", {{"class", "all states"}});
  writeHeadRow(html, {"Procedure", "of the time", "times", "median", "what the hand does",
                      "cue proposed", "what it adds"});
  const auto body = html.in("tbody");
  for (std::size_t k = 0; k < p.shares.size(); ++k) {
    const ProcedureShare& share = p.shares[k];
    if (share.visits == 0) continue;
    const calibration::InteractiveProcedure& one = p.library.procedures[k];
    const auto row = html.in("tr");
    html.element("th", {{"scope", "row"}, {"class", "name"}}, one.name);
    html.element("td", percentOf(share.share));
    html.element("td", std::to_string(share.visits));
    html.element("td", fixed(share.median_s, 2) + " s");
    for (const std::string& words : {one.means, one.cue.kind, one.cue.means})
      html.element("td", {{"class", "name"}}, words);
  }
}

void writeRecall(Html& html, const ProcedureProposal& p) {
  const auto scroll = html.in("div", {{"class", "scroll"}, {"tabindex", "0"}});
  const auto table = html.in("table", {{"class", "all states"}});
  std::vector<std::string> heads{"Labelled", "seconds", "recall", "precision"};
  std::vector<std::size_t> columns;
  for (std::size_t k = 0; k < p.agreement.each.size(); ++k)
    if (p.agreement.each[k].labelled + p.agreement.each[k].matched > 0) columns.push_back(k);
  for (const std::size_t k : columns) heads.push_back("as " + p.library.procedures[k].name);
  writeHeadRow(html, heads);
  const auto body = html.in("tbody");
  for (const std::size_t k : columns) {
    const ProcedureCount& count = p.agreement.each[k];
    const auto row = html.in("tr");
    html.element("th", {{"scope", "row"}, {"class", "name"}}, p.library.procedures[k].name);
    html.element("td", fixed(kStepWide_s * count.labelled, 1));
    html.element("td", count.labelled > 0 ? fixed(count.recall(), 2) : "–");
    html.element("td", count.matched > 0 ? fixed(count.precision(), 2) : "–");
    for (const std::size_t c : columns)
      html.element("td", {{"class", c == k ? "mine" : ""}},
                   fixed(kStepWide_s * p.agreement.table(static_cast<Eigen::Index>(k),
                                                         static_cast<Eigen::Index>(c)),
                         1));
  }
}

void writeByTask(Html& html, const ProcedureProposal& p) {
  const auto table = html.in("table", {{"class", "facts"}});
  const auto body = html.in("tbody");
  for (const TaskAgreement& task : p.tasks)
    writeFact(html, task.task, agreementInShort(task.agreement),
              counted(task.recordings, "recording") + "; " +
                  percentOf(1.0 * task.agreement.judged / std::max(task.agreement.steps, 1)) +
                  " of the time has a label that says what the hand does");
}

void drawVisits(Html& svg, const Axis& x, double top, const std::vector<int>& steps, int procedure,
                const char* css) {
  std::string way;
  for (const ProposedPart& part : partsOf(steps)) {
    if (part.procedure != procedure) continue;
    const double from = x.at(part.from_s), to = std::max(x.at(part.to_s), from + kLeastWide);
    way += "M" + coordinate(from) + " " + coordinate(top) + "H" + coordinate(to) + "V" +
           coordinate(top + kProcedureBar) + "H" + coordinate(from) + "Z";
  }
  if (!way.empty()) svg.empty("path", {{"class", css}, {"d", way}});
}

/// A lane a procedure: above what was recognised, below it, lower, what the task's label says.
void drawSequence(Html& html, const ProcedureProposal& p, const ProposedSequence& q,
                  const ChartFrame& given) {
  ChartFrame frame = given;
  frame.left = frame.wide ? 140 : 84;
  std::vector<int> lanes;
  for (int k = 0; k < static_cast<int>(p.shares.size()); ++k)
    if (std::find(q.matched.begin(), q.matched.end(), k) != q.matched.end() ||
        std::find(q.labelled.begin(), q.labelled.end(), k) != q.labelled.end())
      lanes.push_back(k);
  const Axis x = frame.across(0, kStepWide_s * static_cast<double>(q.matched.size()));
  const double bottom = 2 * kProcedurePitch * static_cast<double>(lanes.size()) + 4;
  const auto svg = openSvg(html, frame, bottom + 42,
                           q.trial + ": what was recognised, and below each what the labels say");
  double top = 2;
  for (const int k : lanes) {
    const std::string& name = p.library.procedures[static_cast<std::size_t>(k)].name;
    svgText(html, "tick", 0, top + kProcedureBar - 2, fitted(name, frame.left - 6, frame.font));
    svgText(html, "tick", 0, top + kProcedurePitch + kProcedureBar - 2, "  label");
    for (const auto& [steps, css] :
         {std::pair(&q.matched, "found"), std::pair(&q.labelled, "written")}) {
      svgRect(html, "lane", x.from_px, top, x.to_px - x.from_px, kProcedureBar);
      drawVisits(html, x, top, *steps, k, css);
      top += kProcedurePitch;
    }
  }
  drawTimeAxis(html, frame, x, bottom, "time of the trial, s");
}

void writeProcedureCards(Html& html, const ProcedureProposal& p, const std::string& made_by) {
  {
    const auto section = html.in("section", {{"class", "card"}});
    html.element("h2", "What is proposed");
    writeProposed(html, p);
    html.element("p", {{"class", "muted small"}},
                 "Recognised by position, velocity and force alone, by a library of interactive "
                 "procedures; the cue is what the library maps to each. The times of each part "
                 "stand in procedures.json.");
  }
  {
    const auto section = html.in("section", {{"class", "card"}});
    html.element("h2", "Beside the tasks' labels");
    for (const std::string& sentence : wordsOf(p)) html.element("p", sentence);
    writeRecall(html, p);
    writeByTask(html, p);
    html.element("p", {{"class", "muted small"}},
                 "Seconds by label (rows) and by what was recognised (columns). A task's labels "
                 "become procedures by the library's own rules; steps whose label does not say "
                 "what the hand does are not judged.");
  }
  {
    const auto section = html.in("section", {{"class", "card"}});
    html.element("h2", "Trials over time");
    html.element("p", {{"class", "muted small"}},
                 "Blue: what was recognised. Grey, below it: what the task's labels say.");
    for (std::size_t i = 0; i < std::min(kStrips, p.sequences.size()); ++i) {
      const auto figure = html.in("figure");
      html.element("h3", p.sequences[i].task + ": " + p.sequences[i].trial);
      for (const ChartFrame& frame : {kWide, kNarrow}) drawSequence(html, p, p.sequences[i], frame);
    }
  }
  html.element("p", {{"class", "muted small"}},
               "Made by: " + made_by + ". Library: " + p.library.made_by + ".");
}

}  // namespace

std::string agreementInShort(const ProcedureAgreement& agreement) {
  if (agreement.judged == 0) return "not judged";
  return agreement.oneProcedure() ? percentOf(agreement.agreed()) + " alike"
                                  : "kappa " + fixed(agreement.kappa, 2);
}

std::vector<std::string> wordsOf(const ProcedureProposal& proposal) {
  std::vector<std::string> words;
  const ProcedureAgreement& a = proposal.agreement;
  if (a.judged == 0)
    return {"No label of these recordings says what the hand does: there is nothing to judge by."};
  words.push_back(
      (a.oneProcedure() ? "All labels mean one procedure, so that kappa says nothing: " +
                              percentOf(a.agreed()) + " of the time alike"
                        : "Kappa " + fixed(a.kappa, 2)) +
      " against the tasks' labels, over " + fixed(kStepWide_s * a.judged, 0) + " s of " +
      fixed(kStepWide_s * a.steps, 0) + " s; names are names, and no matching is sought.");
  std::string recalls;
  for (std::size_t k = 0; k < a.each.size(); ++k)
    if (a.each[k].labelled > 0)
      recalls += (recalls.empty() ? "" : ", ") + proposal.library.procedures[k].name + " " +
                 fixed(a.each[k].recall(), 2);
  words.push_back("Recall: " + recalls + ".");
  return words;
}

void writeProcedurePage(const ProcedureProposal& proposal, const std::string& made_by,
                        const std::string& date, const std::filesystem::path& file) {
  const std::string title = "Interactive procedures in recorded tasks";
  PageFrame frame{title,
                  title,
                  {{"Date", date}, {"Trials", std::to_string(proposal.sequences.size())}},
                  "",
                  subtaskChartStyle() + "svg .found{fill:var(--blue)}\n"};
  if (proposal.simulated)
    frame.simulated =
        "Library or recordings are of simulated hands: it says how the program's own hands move, "
        "nothing about people.";
  writeFramed(
      frame, [](Html&) {}, [&](Html& html) { writeProcedureCards(html, proposal, made_by); }, file);
}

}  // namespace palpa::calibrate
