#include "apps/calibrate/procedure_proposal.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/quantile.h"

namespace palpa::calibrate {
namespace {

using nlohmann::ordered_json;

constexpr double kProposalStep_s = 1e-9 * static_cast<double>(kSubtaskStep_ns);

using Rows = std::vector<std::vector<int>>;

ProcedureAgreement agreementIn(const ProcedureProposal& proposal, const std::string& task) {
  Rows matched, labelled;
  for (const ProposedSequence& q : proposal.sequences)
    if (task.empty() || q.task == task) {
      matched.push_back(q.matched);
      labelled.push_back(q.labelled);
    }
  return procedureAgreement(proposal.library.procedures.size(), matched, labelled);
}

std::vector<ProcedureShare> sharesOf(const ProcedureProposal& proposal) {
  std::vector<ProcedureShare> shares(proposal.library.procedures.size());
  std::vector<std::vector<double>> visits(shares.size());
  double all_s = 0;
  for (const ProposedSequence& q : proposal.sequences)
    for (const ProposedPart& part : q.parts) {
      const double seconds = part.to_s - part.from_s;
      visits[static_cast<std::size_t>(part.procedure)].push_back(seconds);
      all_s += seconds;
    }
  for (std::size_t k = 0; k < shares.size(); ++k) {
    if (visits[k].empty()) continue;
    for (const double seconds : visits[k]) shares[k].share += seconds / all_s;
    shares[k].visits = static_cast<int>(visits[k].size());
    shares[k].median_s = upperMedian(visits[k]);
  }
  return shares;
}

ordered_json agreementJson(const ProcedureProposal& proposal, const ProcedureAgreement& a) {
  ordered_json each = ordered_json::array();
  for (std::size_t k = 0; k < a.each.size(); ++k) {
    const ProcedureCount& count = a.each[k];
    if (count.labelled == 0 && count.matched == 0) continue;
    each.push_back(
        {{"procedure", proposal.library.procedures[k].name},
         {"labelled_s", kProposalStep_s * count.labelled},
         {"matched_s", kProposalStep_s * count.matched},
         {"recall", count.labelled ? ordered_json(count.recall()) : ordered_json()},
         {"precision", count.matched ? ordered_json(count.precision()) : ordered_json()}});
  }
  return {{"all_s", kProposalStep_s * a.steps},
          {"judged_s", kProposalStep_s * a.judged},
          {"agreed", a.judged > 0 ? ordered_json(a.agreed()) : ordered_json()},
          {"kappa", a.judged > 0 && !a.oneProcedure() ? ordered_json(a.kappa) : ordered_json()},
          {"procedures", each}};
}

ordered_json sequenceJson(const ProcedureProposal& proposal, const ProposedSequence& q) {
  ordered_json parts = ordered_json::array();
  for (const ProposedPart& part : q.parts) {
    const calibration::InteractiveProcedure& p =
        proposal.library.procedures[static_cast<std::size_t>(part.procedure)];
    parts.push_back(
        {{"procedure", p.name}, {"from_s", part.from_s}, {"to_s", part.to_s}, {"cue", p.cue.kind}});
  }
  return {{"trial", q.trial}, {"task", q.task}, {"begins_s", q.begins_s}, {"parts", parts}};
}

std::string folderOf(const std::filesystem::path& file) {
  const std::filesystem::path whole = std::filesystem::absolute(file);
  return std::filesystem::is_directory(file) ? whole.filename().string()
                                             : whole.parent_path().filename().string();
}

}  // namespace

std::vector<ProposedPart> partsOf(const std::vector<int>& matched) {
  std::vector<ProposedPart> parts;
  for (std::size_t i = 0; i < matched.size(); ++i) {
    const double from_s = kProposalStep_s * static_cast<double>(i);
    if (i == 0 || matched[i] != matched[i - 1]) parts.push_back({matched[i], from_s, from_s});
    parts.back().to_s = kProposalStep_s * static_cast<double>(i + 1);
  }
  return parts;
}

std::vector<SubtaskRecordings> readRecordingsOfTasks(
    const std::vector<std::filesystem::path>& files) {
  std::vector<SubtaskRecordings> all;
  for (const std::filesystem::path& file : files) {
    all.push_back(readSubtaskRecordings({file}));
    if (files.size() < 2) continue;
    for (SubtaskSequence& q : all.back().sequences) q.trial.insert(0, folderOf(file) + ", ");
  }
  return all;
}

ProcedureProposal propose(const calibration::ProcedureLibrary& library,
                          const std::vector<SubtaskRecordings>& recordings) {
  ProcedureProposal p{.library = library,
                      .sequences = {},
                      .shares = {},
                      .agreement = {},
                      .tasks = {},
                      .simulated = library.simulated};
  for (const SubtaskRecordings& r : recordings) {
    p.simulated = p.simulated || r.simulated;
    const auto known = std::find_if(p.tasks.begin(), p.tasks.end(),
                                    [&](const TaskAgreement& t) { return t.task == r.task; });
    if (known == p.tasks.end())
      p.tasks.push_back({r.task, 1, {}});
    else
      ++known->recordings;
    for (const SubtaskSequence& q : r.sequences) {
      std::vector<int> matched = matchProcedures(library, q.motion);
      p.sequences.push_back({.trial = q.trial,
                             .task = r.task,
                             .begins_s = q.begins_s,
                             .matched = matched,
                             .labelled = proceduresOf(library, r, q),
                             .parts = partsOf(matched)});
    }
  }
  if (p.sequences.empty())
    throw Error("the recordings hold no trial of half a second", "palpa calibrate subtasks",
                "Record whole trials");
  p.shares = sharesOf(p);
  p.agreement = agreementIn(p, "");
  for (TaskAgreement& task : p.tasks) task.agreement = agreementIn(p, task.task);
  return p;
}

ordered_json toJson(const ProcedureProposal& proposal) {
  ordered_json procedures = ordered_json::array(), sequences = ordered_json::array(),
               tasks = ordered_json::array();
  for (std::size_t k = 0; k < proposal.shares.size(); ++k) {
    if (proposal.shares[k].visits == 0) continue;
    const calibration::InteractiveProcedure& p = proposal.library.procedures[k];
    procedures.push_back({{"name", p.name},
                          {"means", p.means},
                          {"cue", {{"kind", p.cue.kind}, {"means", p.cue.means}}},
                          {"share", proposal.shares[k].share},
                          {"visits", proposal.shares[k].visits},
                          {"median_s", proposal.shares[k].median_s}});
  }
  for (const ProposedSequence& q : proposal.sequences)
    sequences.push_back(sequenceJson(proposal, q));
  for (const TaskAgreement& task : proposal.tasks) {
    ordered_json one{{"task", task.task}, {"recordings", task.recordings}};
    one.update(agreementJson(proposal, task.agreement));
    tasks.push_back(one);
  }
  return {{"simulated", proposal.simulated},
          {"procedures", procedures},
          {"agreement", agreementJson(proposal, proposal.agreement)},
          {"tasks", tasks},
          {"trials", sequences}};
}

}  // namespace palpa::calibrate
