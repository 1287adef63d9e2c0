#include "apps/calibrate/procedure_learning.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "anatomy/base/error.h"

namespace palpa::calibrate {
namespace {

using calibration::LabelRule;
using calibration::ProcedureLibrary;
using calibration::ProcedureProfile;

constexpr double kStepOfProcedure_s = 1e-9 * static_cast<double>(kSubtaskStep_ns);
constexpr int kThinned = 3;            // steps of 30 ms: neighbours tell nearly the same
constexpr int kMostProfiles = 4;       // of a procedure in one task
constexpr double kLeastProfile_s = 3;  // of recordings, or it is an accident
constexpr double kLeastVisit_s = 0.03, kMostLeast_s = 0.4;
constexpr double kShortVisits = 0.1;  // of visits may be shorter than the least

bool holdsFor(const LabelRule& rule, const SubtaskRecordings& recordings, int label, int part) {
  if (rule.task != recordings.task || (rule.part >= 0 && rule.part != part)) return false;
  if (rule.parts.empty()) return rule.part >= 0 || label == 0;
  for (const std::string& name : rule.parts) {
    const auto found = std::find_if(recordings.parts.begin(), recordings.parts.end(),
                                    [&](const station::NamedPart& p) { return p.name == name; });
    if (found == recordings.parts.end() || !(label >> (found - recordings.parts.begin()) & 1))
      return false;
  }
  return true;
}

/// What is gathered of one procedure.
struct Gathered {
  std::map<std::string, std::vector<Eigen::RowVectorXd>> rows;  ///< by task
  std::vector<double> visits_s;
};

void gather(const SubtaskSequence& sequence, const std::vector<int>& procedures,
            const std::string& task, std::vector<Gathered>* all) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= procedures.size(); ++i) {
    if (i < procedures.size() && procedures[i] == procedures[begin]) continue;
    if (procedures[begin] != kNoProcedure) {
      Gathered& one = (*all)[static_cast<std::size_t>(procedures[begin])];
      one.visits_s.push_back(kStepOfProcedure_s * static_cast<double>(i - begin));
      for (std::size_t k = begin; k < i; ++k)
        if (k % kThinned == 0)
          one.rows[task].push_back(sequence.motion.row(static_cast<Eigen::Index>(k)));
    }
    begin = i;
  }
}

Eigen::MatrixXd matrixOf(const std::vector<Eigen::RowVectorXd>& rows) {
  Eigen::MatrixXd x(static_cast<Eigen::Index>(rows.size()), rows.front().size());
  for (std::size_t i = 0; i < rows.size(); ++i) x.row(static_cast<Eigen::Index>(i)) = rows[i];
  return x;
}

void learnProfiles(const Gathered& gathered, const ProcedureLibrary& library, std::uint64_t seed,
                   calibration::InteractiveProcedure* procedure) {
  std::vector<std::vector<ProcedureProfile>> groups;
  for (const auto& [task, rows] : gathered.rows)
    groups.push_back(calibration::fitProfiles(matrixOf(rows), task, library.any, kMostProfiles,
                                              kThinned * kStepOfProcedure_s, kLeastProfile_s,
                                              seed));
  const auto sources = static_cast<double>(groups.size());
  procedure->profiles.clear();
  for (std::vector<ProcedureProfile>& group : groups)
    for (ProcedureProfile& profile : group) {
      profile.share /= sources;
      procedure->profiles.push_back(std::move(profile));
    }
}

void learnVisits(std::vector<double> visits_s, calibration::InteractiveProcedure* procedure) {
  if (visits_s.empty()) return;
  std::sort(visits_s.begin(), visits_s.end());
  const auto place = static_cast<std::size_t>(kShortVisits * static_cast<double>(visits_s.size()));
  procedure->least_s = std::clamp(visits_s[place], kLeastVisit_s, kMostLeast_s);
  double sum = 0;
  for (const double one : visits_s) sum += one;
  procedure->mean_s =
      std::max(sum / static_cast<double>(visits_s.size()), 1.5 * procedure->least_s);
}

}  // namespace

int procedureOf(const ProcedureLibrary& library, const SubtaskRecordings& recordings, int label,
                int part) {
  for (const LabelRule& rule : library.labels)
    if (holdsFor(rule, recordings, label, part)) return library.indexOf(rule.procedure);
  return kNoProcedure;
}

std::vector<int> proceduresOf(const ProcedureLibrary& library, const SubtaskRecordings& recordings,
                              const SubtaskSequence& sequence) {
  std::vector<int> procedures;
  for (std::size_t i = 0; i < sequence.labels.size(); ++i)
    procedures.push_back(procedureOf(library, recordings, sequence.labels[i], sequence.parts[i]));
  return procedures;
}

ProcedureLibrary learnedFrom(const ProcedureLibrary& written,
                             const std::vector<SubtaskRecordings>& recordings, std::uint64_t seed) {
  ProcedureLibrary library = written;
  std::vector<Gathered> gathered(library.procedures.size());
  std::vector<Eigen::MatrixXd> all;
  for (const SubtaskRecordings& r : recordings)
    for (const SubtaskSequence& q : r.sequences) {
      all.push_back(q.motion);
      gather(q, proceduresOf(library, r, q), r.task, &gathered);
    }
  if (std::all_of(gathered.begin(), gathered.end(),
                  [](const Gathered& g) { return g.rows.empty(); }))
    throw Error("no label of these recordings means a procedure of the library",
                "palpa calibrate procedures", "Add rules to its \"labels\"");
  library.any = calibration::rangesOf(all);
  for (std::size_t k = 0; k < gathered.size(); ++k) {
    if (gathered[k].rows.empty()) continue;
    learnProfiles(gathered[k], library, seed, &library.procedures[k]);
    learnVisits(gathered[k].visits_s, &library.procedures[k]);
  }
  return library;
}

ProcedureAgreement procedureAgreement(std::size_t procedures,
                                      const std::vector<std::vector<int>>& matched,
                                      const std::vector<std::vector<int>>& labelled) {
  ProcedureAgreement a;
  const auto count = static_cast<Eigen::Index>(procedures);
  a.table = Eigen::MatrixXi::Zero(count, count);
  for (std::size_t q = 0; q < matched.size(); ++q)
    for (std::size_t i = 0; i < matched[q].size(); ++i) {
      ++a.steps;
      if (labelled[q][i] != kNoProcedure) ++a.table(labelled[q][i], matched[q][i]);
    }
  a.judged = a.table.sum();
  if (a.judged > 0) a.kappa = calibration::kappaByName(a.table);
  for (Eigen::Index k = 0; k < count; ++k)
    a.each.push_back({a.table.row(k).sum(), a.table.col(k).sum(), a.table(k, k)});
  return a;
}

}  // namespace palpa::calibrate
