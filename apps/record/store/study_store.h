#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/record/store/record_store.h"

namespace palpa::record {

/// Somebody's place in a study.
struct Enrolment {
  std::string study;  ///< the protocol's id
  std::string trainee, group;
  std::int64_t place = 0;  ///< 1, 2, ... in this group, by enrolment
  std::string condition;   ///< that was drawn; empty: the protocol draws none
  bool simulated = false;
  std::string enrolled_utc;
};

/// What one file of a study looked like when the first trainee was enrolled: the rest must see the
/// same.
struct StudyBeginning {
  std::string study, protocol_sha256;
  std::uint64_t seed = 0;  ///< taken where the study begins, unused afterwards
  std::string now_utc;
};

/// One item of a questionnaire, answered after a session of the protocol (1, 2, ...).
struct ItemAnswer {
  std::string study, trainee;
  std::int64_t session = 1;
  std::string item, questionnaire, answer, answered_utc;
};

/// Who takes part in studies, in which condition, and what they answered: in the store of a centre.
/// Every call is one transaction.
class StudyStore {
 public:
  explicit StudyStore(RecordStore& store) : connection_(store.connection()) {}

  /// The condition of a place, by the study's seed.
  using Draw = std::function<std::string(std::uint64_t seed, std::int64_t place)>;
  /// Enrols; whoever is enrolled already keeps place and condition. The next place of the group is
  /// given and its condition drawn under the group's lock, so that several stations never give one
  /// place twice, and nobody sees a condition before it is used. Throws UsageError for a trainee
  /// who is not in the records, or a study that began by another protocol file.
  Enrolment enrol(const StudyBeginning& beginning, const Enrolment& wanted, const Draw& draw);
  std::optional<Enrolment> enrolment(const std::string& study, const std::string& trainee);
  std::vector<Enrolment> enrolments(const std::string& study);  ///< by group and place
  std::int64_t placesGiven(const std::string& study,
                           const std::string& group);  ///< those of deleted persons among them

  void answer(const ItemAnswer& answer);  ///< the first answer to an item stays
  std::vector<ItemAnswer> answers(const std::string& study,
                                  const std::string& trainee = "");  ///< by trainee, session, item

 private:
  /// Within a transaction; throws UsageError for another protocol
  std::uint64_t seedOf(const StudyBeginning& beginning);
  SqlConnection& connection_;
};

/// What a human rater said of one item of a form, about one trial. Forms and values are the form's:
/// apps/assess/competence.
struct Rating {
  std::string session;
  std::int64_t number = 0;        ///< of the trial
  std::string rater;              ///< a pseudonym
  std::string form, form_sha256;  ///< which form, and which edition of it
  std::string item;
  std::int64_t value = 0;
  std::string entered_utc;
};

/// All ratings of one rater, form and trial, in one transaction; what he said before of that trial
/// on that form is replaced, so that a slip of typing can be mended. Throws UsageError for a trial
/// that is not in the records, a rater's name that is no pseudonym, or ratings of several trials,
/// raters or forms at once.
void enterRatings(RecordStore& store, const std::vector<Rating>& ratings);

/// Those of a session, or all where `session` is empty; by session, trial, rater, form, item.
std::vector<Rating> ratingsIn(RecordStore& store, const std::string& session = "");

}  // namespace palpa::record
