#include "apps/calibrate/subtask_result.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/counted.h"
#include "apps/report/page/page_parts.h"

namespace palpa::calibrate {
namespace {

using report::fixed;

constexpr double kStep_s = 1e-9 * static_cast<double>(kSubtaskStep_ns);
constexpr std::size_t kFewTrials = 6, kNamedDifferences = 3;
constexpr double kNamedShare = 0.02;  // of all steps: differences below are not named
constexpr double kBusy_s =
    0.2;  // changes that follow each other within this lie within 100 ms of nearly anything

std::string percent(double share) {
  return fixed(100 * share, share > 0.0005 && share < 0.0095 ? 1 : 0) + " %";
}
std::string quoted(const std::string& words) { return "\"" + words + "\""; }
std::string atLeast(double value, double least, double unit, const std::string& name,
                    int decimals) {
  return value <= least * (1 + 1e-9)
             ? "under " + fixed(least / unit, decimals) + " " + name
             : fixed(value / unit, value / unit < 10 ? std::max(decimals, 1) : decimals) + " " +
                   name;
}

double secondsOf(const SubtaskRecordings& recordings) {
  double seconds = 0;
  for (const SubtaskSequence& q : recordings.sequences)
    seconds += kStep_s * static_cast<double>(q.labels.size());
  return seconds;
}

/// "every 31 ms (3061 times)"
std::string pace(int changes, double seconds) {
  if (changes == 0) return "never";
  const double each = seconds / changes;
  return "every " + (each < 1 ? fixed(1e3 * each, 0) + " ms" : fixed(each, 1) + " s") + " (" +
         howOften(changes) + ")";
}

struct Difference {
  std::size_t row, column;
  double share;
};

/// Cells of the table that are no matched pair, the largest first.
std::vector<Difference> differencesOf(const SubtaskSegmentation& found) {
  std::vector<Difference> all;
  const double steps = found.steps.counts.sum();
  for (std::size_t row = 0; row < found.steps.one.size(); ++row)
    for (std::size_t c = 0; c < found.steps.other.size(); ++c)
      if (found.matching[row] != static_cast<int>(c))
        all.push_back(
            {row, c,
             found.steps.counts(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(c)) /
                 steps});
  std::stable_sort(all.begin(), all.end(),
                   [](const Difference& a, const Difference& b) { return a.share > b.share; });
  return all;
}

}  // namespace

std::string wordsOf(const StateLook& look) {
  return atLeast(look.speed, kLeastSpeed, 1e-3, "mm/s", 0) + ", " +
         atLeast(look.force, kLeastForce_N, 1, "N", 2) + ", in contact " + percent(look.contact) +
         " of its time, force shaking by " + atLeast(look.shaking, kLeastShaking_N, 1, "N", 3);
}

const char* agreementWords(double kappa) {
  return kappa < 0.4   ? "little agreement: what the hands did does not fall into the hand-written "
                         "parts, or the features do not show them"
         : kappa < 0.6 ? "moderate agreement"
         : kappa < 0.8 ? "good agreement"
                       : "close agreement";
}

Sentences howMany(const SubtaskRecordings& recordings, const SubtaskSegmentation& found) {
  const calibration::StatesProposal& p = found.proposal;
  Sentences s;
  s.push_back(
      counted(recordings.sequences.size(), "trial") + ", " + fixed(secondsOf(recordings), 0) +
      " s in all. " +
      (found.states == std::min(p.states, p.repeatable) ? "Proposed: " : "Taken, as asked: ") +
      counted(found.states, "state") + ".");
  s.push_back("Trials that were held out are predicted best by " + counted(p.best, "state") +
              "; as well within one standard error by " + std::to_string(p.states) +
              ". Fits to two halves of the trials find the same for up to " +
              std::to_string(p.repeatable) +
              (p.best == static_cast<int>(p.curve.size()) && p.best > 1
                   ? ". " + std::to_string(p.best) + " is the most that was offered."
                   : "."));
  if (found.states > 1)
    s.push_back(std::string(found.repeated() >= kRepeats ? "This is repeatable: "
                                                         : "This is not repeatable: ") +
                "the segmentations that two halves of the trials find agree by " +
                fixed(found.repeated(), 2) + " (adjusted Rand index; 1: the same, 0: chance).");
  else
    s.push_back("One state: nothing in speed, force and contact divides the trials.");
  return s;
}

Sentences whatTheyAre(const SubtaskRecordings& recordings, const SubtaskSegmentation& found) {
  Sentences s;
  for (std::size_t row = 0; row < found.looks.size(); ++row) {
    const StateLook& look = found.looks[row];
    const std::string part = partOf(recordings, found, row);
    s.push_back("State " + stateName(found, row) + ", " + percent(look.share) +
                " of the time: " + wordsOf(look) + ". " + percent(look.mostly_share) +
                " of it is " + quoted(recordings.wordsOf(look.mostly)) +
                (part.empty() ? "; no hand-written part of its own goes with it."
                              : "; it goes with " + quoted(part) + "."));
  }
  return s;
}

Sentences howTheyAgree(const SubtaskRecordings& recordings, const SubtaskSegmentation& found) {
  const SubtaskAgreement& a = found.agreement;
  const calibration::BoundaryAgreement& b = a.boundaries;
  const double seconds = secondsOf(recordings);
  Sentences s;
  s.push_back("Beside the hand-written parts: kappa " + fixed(a.kappa, 2) + ", " +
              agreementWords(a.kappa) + ". Adjusted Rand index " + fixed(a.rand, 2) +
              ". Parts as long but at other times reach kappa " + fixed(found.by_chance.kappa, 2) +
              " and Rand " + fixed(found.by_chance.rand, 2) + " by chance (1 time in 20).");
  s.push_back(
      "The hand-written parts change " + pace(b.expected, seconds) + ", the proposed states " +
      pace(b.found, seconds) + ". Within 100 ms of each other lie " + percent(b.precision()) +
      " of the proposed changes and " + percent(b.recall()) + " of the hand-written ones: F " +
      fixed(b.f(), 2) + ", by chance " + fixed(found.by_chance.boundary_f, 2) +
      (b.f() <= found.by_chance.boundary_f ? ". That is no more than chance." : "."));
  if (b.expected > 0 && seconds / b.expected < kBusy_s)
    s.push_back(
        "Hand-written parts that change so quickly are near a threshold much of the time: look at "
        "their thresholds and their hysteresis before anything else.");
  return s;
}

Sentences whereTheyDiffer(const SubtaskRecordings& recordings, const SubtaskSegmentation& found) {
  Sentences s;
  const std::vector<Difference> all = differencesOf(found);
  for (std::size_t i = 0;
       i < std::min(kNamedDifferences, all.size()) && all[i].share >= kNamedShare; ++i) {
    const std::string part = partOf(recordings, found, all[i].row);
    s.push_back("They differ " + percent(all[i].share) +
                " of the time where the hand-written parts say " +
                quoted(recordings.wordsOf(found.steps.other[all[i].column])) +
                " and the hands were in state " + stateName(found, all[i].row) +
                (part.empty() ? "." : ", which goes with " + quoted(part) + "."));
  }
  std::string alone;
  Sentences with_state;
  for (std::size_t row = 0; row < found.steps.one.size(); ++row)
    with_state.push_back(partOf(recordings, found, row));
  for (std::size_t c = 0; c < found.steps.other.size(); ++c)
    if (std::find(with_state.begin(), with_state.end(), recordings.wordsOf(found.steps.other[c])) ==
        with_state.end())
      alone += (alone.empty() ? "" : ", ") + quoted(recordings.wordsOf(found.steps.other[c]));
  if (!alone.empty()) s.push_back("No state of its own: " + alone + ".");
  return s;
}

Sentences whatToMind(const SubtaskRecordings& recordings, const SubtaskSegmentation& found) {
  Sentences s{
      "Neither segmentation is the truth: the one is what somebody wrote, the other what a simple "
      "model cuts from speed, force, contact and shaking. Where they differ, look at the "
      "recording."};
  if (found.neighbours > kIndependent)
    s.push_back(
        "Steps " + std::to_string(10 * found.thinned_to) +
        " ms apart still tell each other (correlation " + fixed(found.neighbours, 2) +
        "): by held-out trials too many states look good; more and longer trials would tell.");
  if (recordings.sequences.size() < kFewTrials)
    s.push_back("With " + counted(recordings.sequences.size(), "trial") +
                " the number of states is uncertain: give " + std::to_string(kFewTrials) +
                " or more, better of several experts.");
  if (found.features.size() < kSubtaskFeatures) {
    std::string unused;
    for (int d = 0; d < kSubtaskFeatures; ++d)
      if (std::find(found.features.begin(), found.features.end(), d) == found.features.end())
        unused += (unused.empty() ? "" : ", ") + std::string(subtaskFeatureName(d).words);
    s.push_back("Not used, because it hardly changes: " + unused + ".");
  }
  if (recordings.augmented > 0)
    s.push_back("In " + counted(recordings.augmented, "trial") +
                " cues might be added to the force in each hand-written part: hands that answer "
                "them follow these parts.");
  if (recordings.left_out > 0)
    s.push_back("Left out, shorter than 0.5 s: " + counted(recordings.left_out, "stretch") + ".");
  return s;
}

}  // namespace palpa::calibrate
