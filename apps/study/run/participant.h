#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "apps/record/store/study_store.h"
#include "apps/study/progress.h"
#include "apps/study/protocol.h"

namespace palpa::study {

/// The experience of virtual trainees, in the records.
inline constexpr const char* kSimulatedExperience = "simulated";

/// Somebody's way through a study: from the records, or, while they cannot be reached, from this
/// station's own copy and the evidence that waits here.
class StudyParticipant {
 public:
  /// Enrols, or goes on; whoever is simulated needs no consent. `seed`: of the study, where it
  /// begins with this one. Throws UsageError for a trainee who is not in the records, has not
  /// agreed to studies, is in none of the groups, or is excluded; StoreUnreachable where this
  /// station knows nothing of him either.
  StudyParticipant(const study::Protocol& protocol, const std::string& trainee,
                   const std::string& url, std::uint64_t seed);

  const record::Enrolment& enrolment() const { return enrolment_; }
  bool online() const { return online_; }
  std::size_t trials() const { return trials_.size(); }
  const std::vector<study::DoneTrial>& done() const { return trials_; }

  study::Next next(const std::string& now_utc) const;
  void refresh();  ///< sends what waits, reads what is there
  void answer(int session, const std::string& item,
              const std::string& text);  ///< kept here at once, sent when that is possible

 private:
  struct KnownAnswer {
    record::ItemAnswer answer;
    bool sent = false;
  };
  void fromRecords();
  void sendWaiting();
  void addWaiting();
  void readCopy();
  void writeCopy() const;

  const study::Protocol& protocol_;
  const std::string trainee_, url_;
  const std::uint64_t seed_;
  const std::filesystem::path copy_;
  record::Enrolment enrolment_;
  std::vector<study::DoneTrial> trials_;
  std::vector<KnownAnswer> answers_;
  bool online_ = false;
};

/// Who takes no part, and why: the protocol's own list, and the experts whose trials made the
/// expert path of one of its tasks.
std::vector<std::pair<std::string, std::string>> excludedFrom(const study::Protocol& protocol);

/// A virtual trainee in the records, unless he is there. Throws UsageError where a person has that
/// pseudonym.
void addSimulated(record::RecordStore& store, const std::string& id, const std::string& group,
                  const std::string& now_utc);

/// What this station knows of a person who is deleted, so that studies can go on without the
/// records.
void removeStudyCopies(const std::string& trainee);

}  // namespace palpa::study
