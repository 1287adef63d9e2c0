#include <cstdio>

#include "apps/cli/output_folder.h"
#include "apps/cli/study_run.h"
#include "apps/record/store/study_store.h"
#include "apps/study/progress.h"

namespace palpa::cli {
namespace {

using study::Next;

void tellTrainee(const study::Protocol& protocol, record::RecordStore& store,
                 const record::Enrolment& e) {
  std::vector<study::DoneTrial> trials;
  for (const record::TrialWithSession& t :
       store.trials({.trainee = e.trainee, .study = protocol.id}))
    trials.push_back(study::doneTrial(t.session, t.trial));
  std::vector<std::pair<int, std::string>> answered;
  for (const record::Answer& a : record::StudyStore(store).answers(protocol.id, e.trainee))
    answered.emplace_back(static_cast<int>(a.session), a.item);
  const Next next = study::nextOf(protocol, e.condition, trials, answered, utcNow());
  std::printf("  %-12s %-14s %s%s\n", e.trainee.c_str(), e.group.c_str(),
              study::whereIs(protocol, next).c_str(), e.simulated ? " (simulated)" : "");
  for (const std::string& remark : next.remarks) std::printf("    Note: %s\n", remark.c_str());
}

/// Counts of a group alone: those of conditions would tell who is next.
void tellGroup(const study::Protocol& protocol, record::StudyStore& studies,
               const std::string& group) {
  const std::int64_t given = studies.placesGiven(protocol.id, group);
  std::printf("  %-14s %lld place%s given", group.c_str(), static_cast<long long>(given),
              given == 1 ? "" : "s");
  if (protocol.allocation)
    std::printf(
        given % protocol.allocation->block ? "; balanced again after %lld more"
                                           : "; conditions balanced",
        static_cast<long long>(protocol.allocation->block - given % protocol.allocation->block));
  std::printf("\n");
}

}  // namespace

void tellStudy(const StudyOptions& o) {
  const study::Protocol protocol = study::readProtocol(o.protocol);
  record::RecordStore store(o.url);
  record::StudyStore studies(store);
  std::printf("%s (%s)\n", protocol.title.c_str(), protocol.id.c_str());
  for (const study::Group& group : protocol.groups) tellGroup(protocol, studies, group.name);
  const std::vector<record::Enrolment> enrolled = studies.enrolments(protocol.id);
  std::printf("%zu enrolled\n", enrolled.size());
  for (const record::Enrolment& e : enrolled) tellTrainee(protocol, store, e);
}

}  // namespace palpa::cli
