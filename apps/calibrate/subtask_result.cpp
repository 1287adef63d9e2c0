#include "apps/calibrate/subtask_result.h"

namespace palpa::calibrate {
namespace {

constexpr int kSubtasksGoodFor_days =
    3650;  // hands' ways do not age; other experts are another matter

constexpr double kLeastOfState =
    0.25;  // of a state: with less of it a part only happens to be left by the matching

using station::CalibrationFile;

std::vector<double> listed(const Eigen::VectorXd& values) {
  return {values.data(), values.data() + values.size()};
}

void addModel(const SubtaskSegmentation& found, CalibrationFile* file) {
  const calibration::HiddenMarkov& m = found.model;
  const auto add = [&](const std::string& name, std::vector<double> values) {
    file->parameters.push_back({name, std::move(values)});
  };
  add("states", {static_cast<double>(found.states)});
  add("step_s", {1e-9 * static_cast<double>(kSubtaskStep_ns)});
  add("fitted_to_every_s", {1e-9 * static_cast<double>(kSubtaskStep_ns) * found.thinned_to});
  add("neighbours_correlation", {found.neighbours});
  add("least_speed_m_per_s", {kLeastSpeed});
  add("least_force_N", {kLeastForce_N});
  add("least_shaking_N", {kLeastShaking_N});
  add("start", listed(m.start));
  for (Eigen::Index k = 0; k < m.states(); ++k)
    add("move_from_state_" + std::to_string(k + 1), listed(m.transition.row(k).transpose()));
  for (std::size_t d = 0; d < found.features.size(); ++d) {
    const auto column = static_cast<Eigen::Index>(d);
    const std::string name = subtaskFeatureName(found.features[d]).name;
    add("standardised_by_" + name, {found.centre[column], found.spread[column]});
    add("mean_" + name, listed(m.mean.col(column)));
    add("variance_" + name, listed(m.variance.col(column)));
  }
}

void addCurve(const calibration::StatesProposal& proposal, CalibrationFile* file) {
  std::vector<double> states, means, errors, repeated;
  for (const calibration::HeldOut& one : proposal.curve) {
    states.push_back(one.states);
    means.push_back(one.mean);
    errors.push_back(one.standard_error);
    repeated.push_back(one.repeated);
  }
  file->parameters.push_back({"held_out_states", states});
  file->parameters.push_back({"held_out_nats_per_step", means});
  file->parameters.push_back({"held_out_standard_error_nats_per_step", errors});
  file->parameters.push_back({"repeated_by_halves_rand_index", repeated});
  file->parameters.push_back(
      {"states_by_one_standard_error", {static_cast<double>(proposal.states)}});
  file->parameters.push_back({"states_repeatable", {static_cast<double>(proposal.repeatable)}});
}

void addAgreement(const SubtaskRecordings& recordings, const SubtaskSegmentation& found,
                  CalibrationFile* file) {
  const SubtaskAgreement& a = found.agreement;
  const auto add = [&](const std::string& name, std::vector<double> values) {
    file->parameters.push_back({name, std::move(values)});
  };
  add("kappa", {a.kappa});
  add("adjusted_rand_index", {a.rand});
  add("boundary_tolerance_s", {1e-9 * static_cast<double>(kSubtaskStep_ns) * kBoundaryTolerance});
  add("boundary_precision", {a.boundaries.precision()});
  add("boundary_recall", {a.boundaries.recall()});
  add("boundary_f", {a.boundaries.f()});
  add("boundaries_met_proposed_written",
      {static_cast<double>(a.boundaries.met), static_cast<double>(a.boundaries.found),
       static_cast<double>(a.boundaries.expected)});
  add("by_chance_kappa_rand_f",
      {found.by_chance.kappa, found.by_chance.rand, found.by_chance.boundary_f});
  for (std::size_t c = 0; c < found.steps.other.size(); ++c) {
    std::vector<double> counts(static_cast<std::size_t>(found.states));
    for (std::size_t row = 0; row < found.steps.one.size(); ++row)
      counts[static_cast<std::size_t>(found.steps.one[row])] =
          found.steps.counts(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(c));
    add("steps_by_state of " + recordings.wordsOf(found.steps.other[c]), counts);
  }
}

}  // namespace

std::string stateName(const SubtaskSegmentation& found, std::size_t row) {
  return std::to_string(found.steps.one[row] + 1);
}

std::string partOf(const SubtaskRecordings& recordings, const SubtaskSegmentation& found,
                   std::size_t row) {
  const int column = found.matching[row];
  const Eigen::RowVectorXi counts = found.steps.counts.row(static_cast<Eigen::Index>(row));
  return column < 0 || counts[column] < kLeastOfState * counts.sum()
             ? ""
             : recordings.wordsOf(found.steps.other[static_cast<std::size_t>(column)]);
}

Result subtaskResult(const SubtaskRecordings& recordings, const SubtaskSegmentation& found,
                     const Origin& origin) {
  Result r;
  r.title = "Parts of the task \"" + recordings.task + "\"";
  r.file = begun(origin, station::CalibrationKind::subtasks, kSubtasksGoodFor_days);
  addModel(found, &r.file);
  addCurve(found.proposal, &r.file);
  addAgreement(recordings, found, &r.file);
  r.file.checks = {{"share by which two halves of the trials cut them differently",
                    found.states > 1 ? 1 - found.repeated() : 0, 1 - kRepeats, ""}};
  for (const SubtaskSequence& q : recordings.sequences) {
    r.file.data.samples += static_cast<int>(q.labels.size());
    r.file.data.used +=
        static_cast<int>((q.labels.size() + static_cast<std::size_t>(found.thinned_to) - 1) /
                         static_cast<std::size_t>(found.thinned_to));
  }
  r.file.verdict = verdictOf(r.file.checks);
  for (const auto& group : {howMany(recordings, found), whatTheyAre(recordings, found),
                            howTheyAgree(recordings, found), whereTheyDiffer(recordings, found)})
    r.sentences.insert(r.sentences.end(), group.begin(), group.end());
  r.advice = whatToMind(recordings, found);
  return r;
}

}  // namespace palpa::calibrate
