#include "apps/assess/competence/rating_agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "anatomy/base/error.h"
#include "apps/assess/statistics/sample.h"

namespace palpa::competence {
namespace {

constexpr int kCategories = 3;
const char* const kSimulator = "simulator";

int categoryOf(int answer) { return answer == kDidNotArise ? 2 : answer; }

Answers simulatorsAnswers(const RatedTrial& trial) {
  Answers answers;
  for (const MarkedItem& m : trial.simulator)
    if (!m.item->byRater() && m.mark != Mark::open)
      answers[m.item->id] = m.mark == Mark::done       ? kDone
                            : m.mark == Mark::not_done ? kNotDone
                                                       : kDidNotArise;
  return answers;
}

const Answers* answersOf(const RatedTrial& trial, const std::string& who,
                         const Answers& simulator) {
  if (who == kSimulator) return &simulator;
  const auto found = trial.checklist.find(who);
  return found == trial.checklist.end() ? nullptr : &found->second;
}

PairAgreement agreementOfPair(const std::vector<RatedTrial>& trials, const std::string& one,
                              const std::string& other) {
  std::vector<int> a, b;
  for (const RatedTrial& trial : trials) {
    const Answers simulator = simulatorsAnswers(trial);
    const Answers *first = answersOf(trial, one, simulator),
                  *second = answersOf(trial, other, simulator);
    if (!first || !second) continue;
    for (const auto& [item, value] : *first)
      if (const auto same = second->find(item); same != second->end()) {
        a.push_back(categoryOf(value));
        b.push_back(categoryOf(same->second));
      }
  }
  PairAgreement pair{one, other, static_cast<int>(a.size()), 0,
                     std::numeric_limits<double>::quiet_NaN()};
  if (a.empty()) return pair;
  int alike = 0;
  for (std::size_t i = 0; i < a.size(); ++i) alike += a[i] == b[i];
  pair.alike = alike / static_cast<double>(a.size());
  pair.kappa = statistics::kappa(a, b, kCategories);
  return pair;
}

double meanGrade(const Answers& grades) {
  double sum = 0;
  for (const auto& [item, grade] : grades) sum += grade;
  return sum / static_cast<double>(grades.size());
}

void checklists(const std::vector<RatedTrial>& trials, Agreement* agreement) {
  std::set<std::string> raters;
  for (const RatedTrial& t : trials)
    for (const auto& [rater, answers] : t.checklist) raters.insert(rater);
  std::vector<std::string> all(raters.begin(), raters.end());
  all.emplace_back(kSimulator);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j)
      if (const PairAgreement pair = agreementOfPair(trials, all[i], all[j]); pair.items)
        agreement->checklist.push_back(pair);
  if (agreement->checklist.empty())
    agreement->missing.push_back("No item of a checklist was judged by two: no kappa.");
}

/// Trials x raters, of the trials that all of them rated.
Eigen::MatrixXd meansOf(const std::vector<RatedTrial>& trials,
                        const std::vector<std::string>& raters) {
  std::vector<const RatedTrial*> complete;
  for (const RatedTrial& t : trials)
    if (!raters.empty() && std::all_of(raters.begin(), raters.end(), [&](const std::string& r) {
          return t.global.count(r) && !t.global.at(r).empty();
        }))
      complete.push_back(&t);
  Eigen::MatrixXd means(static_cast<Eigen::Index>(complete.size()),
                        static_cast<Eigen::Index>(raters.size()));
  for (std::size_t i = 0; i < complete.size(); ++i)
    for (std::size_t j = 0; j < raters.size(); ++j)
      means(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          meanGrade(complete[i]->global.at(raters[j]));
  return means;
}

int ratedBy(const std::vector<RatedTrial>& trials, const std::string& rater) {
  return static_cast<int>(std::count_if(trials.begin(), trials.end(), [&](const RatedTrial& t) {
    return t.global.count(rater) && !t.global.at(rater).empty();
  }));
}

/// Whoever rated least is left out until those who stay have two trials in common.
std::vector<std::string> leaveOut(const std::vector<RatedTrial>& trials,
                                  std::vector<std::string>* raters) {
  std::vector<std::string> out;
  while (raters->size() > 2 && meansOf(trials, *raters).rows() < 2) {
    const auto least = std::min_element(raters->begin(), raters->end(),
                                        [&](const std::string& a, const std::string& b) {
                                          return ratedBy(trials, a) < ratedBy(trials, b);
                                        });
    out.push_back(*least);
    raters->erase(least);
  }
  return out;
}

void globals(const std::vector<RatedTrial>& trials, Agreement* agreement) {
  std::set<std::string> raters;
  for (const RatedTrial& t : trials)
    for (const auto& [rater, grades] : t.global) raters.insert(rater);
  agreement->raters.assign(raters.begin(), raters.end());
  const std::vector<std::string> out = leaveOut(trials, &agreement->raters);
  const Eigen::MatrixXd means = meansOf(trials, agreement->raters);
  for (const std::string& rater : out)
    if (means.rows() >= 2)
      agreement->missing.push_back(
          "Rater " + rater + " is left out of the ICC: too few trials in common with the others.");
  agreement->trials = static_cast<int>(means.rows());
  if (means.cols() < 2 || means.rows() < 2) {
    agreement->missing.push_back(
        "An ICC of the global rating needs two raters who rated the same two trials or more: of " +
        std::to_string(raters.size()) + (raters.size() == 1 ? " rater" : " raters") +
        " no two have.");
    return;
  }
  try {
    agreement->global = statistics::raterAgreement(means);
  } catch (const Error& e) {
    agreement->missing.push_back(std::string("No ICC: ") + e.what());
  }
}

double pearson(const std::vector<double>& a, const std::vector<double>& b) {
  const double ma = statistics::meanOf(a), mb = statistics::meanOf(b);
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - ma) * (b[i] - mb);
    aa += (a[i] - ma) * (a[i] - ma);
    bb += (b[i] - mb) * (b[i] - mb);
  }
  return ab / std::sqrt(aa * bb);
}

void withTotals(const std::vector<RatedTrial>& trials, Agreement* agreement) {
  std::vector<double> grades, totals;
  for (const RatedTrial& t : trials) {
    if (!t.total || !std::isfinite(*t.total) || t.global.empty()) continue;
    double sum = 0;
    for (const auto& [rater, answers] : t.global) sum += meanGrade(answers);
    grades.push_back(sum / static_cast<double>(t.global.size()));
    totals.push_back(*t.total);
  }
  agreement->scored = static_cast<int>(grades.size());
  if (grades.size() >= 3)
    if (const double rho = pearson(statistics::ranksOf(grades).of, statistics::ranksOf(totals).of);
        std::isfinite(rho))
      agreement->with_total = rho;
  if (!agreement->with_total)
    agreement->missing.push_back(
        "A correlation of the global rating with the score needs three trials or more that differ "
        "in both.");
}

}  // namespace

Agreement agreementOf(const std::vector<RatedTrial>& trials) {
  Agreement agreement;
  checklists(trials, &agreement);
  globals(trials, &agreement);
  withTotals(trials, &agreement);
  return agreement;
}

}  // namespace palpa::competence
