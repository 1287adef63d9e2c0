#include "apps/record/store/study_store.h"

#include <algorithm>

#include "apps/record/store/migrations.h"

namespace palpa::record {
namespace {

Enrolment enrolmentIn(const SqlRows& r, std::size_t i) {
  return {r.text(i, 0), r.text(i, 1),         r.text(i, 2), r.integer(i, 3),
          r.text(i, 4), r.integer(i, 5) != 0, r.text(i, 6)};
}

}  // namespace

std::uint64_t StudyStore::seedOf(const StudyBeginning& b) {
  connection_.query(
      "INSERT INTO studies(study,protocol_sha256,seed,began_utc) VALUES($1,$2,$3,$4) ON "
      "CONFLICT(study) DO NOTHING",
      {b.study, b.protocol_sha256, std::to_string(b.seed), b.now_utc});
  const SqlRows rows = connection_.query(
      "SELECT protocol_sha256,seed,began_utc FROM studies WHERE study=$1", {b.study});
  if (rows.text(0, 0) != b.protocol_sha256)
    throw UsageError("began on " + rows.text(0, 2).substr(0, 10) + " with another protocol file",
                     "study " + b.study,
                     "Give the file as it was, or give the changed one another id");
  return std::stoull(rows.text(0, 1));
}

Enrolment StudyStore::enrol(const StudyBeginning& beginning, const Enrolment& wanted,
                            const Draw& draw) {
  SqlTransaction transaction(connection_);
  if (connection_.query("SELECT 1 FROM trainees WHERE id=$1", {wanted.trainee}).empty())
    throw UsageError("is not in the records", "trainee " + wanted.trainee,
                     "Add the trainee: palpa records trainee add");
  const std::uint64_t seed = seedOf(beginning);
  // The group's row is written first, so that another station waits here until this enrolment is
  // done.
  connection_.query(
      "INSERT INTO study_groups(study,group_name,given) VALUES($1,$2,0) ON "
      "CONFLICT(study,group_name) DO NOTHING",
      {wanted.study, wanted.group});
  const SqlRows given = connection_.query(
      "UPDATE study_groups SET given=given+1 WHERE study=$1 AND group_name=$2 RETURNING given",
      {wanted.study, wanted.group});
  if (const auto there = enrolment(wanted.study, wanted.trainee))
    return *there;  // rolled back: no place is used
  Enrolment enrolled = wanted;
  enrolled.place = given.integer(0, 0);
  enrolled.condition = draw(seed, enrolled.place);
  connection_.query(
      "INSERT INTO enrolments(" + columnsOf("enrolments") + ") VALUES($1,$2,$3,$4,$5,$6,$7)",
      {enrolled.study, enrolled.trainee, enrolled.group, enrolled.place, enrolled.condition,
       std::int64_t{enrolled.simulated}, enrolled.enrolled_utc});
  transaction.commit();
  return enrolled;
}

std::optional<Enrolment> StudyStore::enrolment(const std::string& study,
                                               const std::string& trainee) {
  const SqlRows rows = connection_.query(
      "SELECT " + columnsOf("enrolments") + " FROM enrolments WHERE study=$1 AND trainee=$2",
      {study, trainee});
  return rows.empty() ? std::nullopt : std::optional(enrolmentIn(rows, 0));
}

std::vector<Enrolment> StudyStore::enrolments(const std::string& study) {
  const SqlRows rows =
      connection_.query("SELECT " + columnsOf("enrolments") +
                            " FROM enrolments WHERE study=$1 ORDER BY group_name,place",
                        {study});
  std::vector<Enrolment> all;
  for (std::size_t i = 0; i < rows.size(); ++i) all.push_back(enrolmentIn(rows, i));
  return all;
}

std::int64_t StudyStore::placesGiven(const std::string& study, const std::string& group) {
  const SqlRows rows = connection_.query(
      "SELECT given FROM study_groups WHERE study=$1 AND group_name=$2", {study, group});
  return rows.empty() ? 0 : rows.integer(0, 0);
}

void StudyStore::answer(const ItemAnswer& a) {
  connection_.query(
      "INSERT INTO answers(" + columnsOf("answers") +
          ") VALUES($1,$2,$3,$4,$5,$6,$7) ON CONFLICT(study,trainee,session,item) DO NOTHING",
      {a.study, a.trainee, a.session, a.item, a.questionnaire, a.answer, a.answered_utc});
}

std::vector<ItemAnswer> StudyStore::answers(const std::string& study, const std::string& trainee) {
  const SqlRows rows = connection_.query(
      "SELECT " + columnsOf("answers") +
          " FROM answers WHERE study=$1 AND ($2='' OR trainee=$2) ORDER BY trainee,session,item",
      {study, trainee});
  std::vector<ItemAnswer> all;
  for (std::size_t i = 0; i < rows.size(); ++i)
    all.push_back({rows.text(i, 0), rows.text(i, 1), rows.integer(i, 2), rows.text(i, 3),
                   rows.text(i, 4), rows.text(i, 5), rows.text(i, 6)});
  return all;
}

namespace {

void requireOneSheet(const std::vector<Rating>& ratings) {
  const Rating& first = ratings.front();
  const auto same = [&](const Rating& r) {
    return r.session == first.session && r.number == first.number && r.rater == first.rater &&
           r.form == first.form && r.form_sha256 == first.form_sha256;
  };
  if (!std::all_of(ratings.begin(), ratings.end(), same))
    throw UsageError("belong to several sheets", "ratings",
                     "Enter one rater's form of one trial at a time");
  if (!whyNoPseudonym(first.rater).empty())
    throw UsageError("must have 1 to 32 letters, digits, - or _", "rater \"" + first.rater + "\"",
                     "Choose a pseudonym");
}

}  // namespace

void enterRatings(RecordStore& store, const std::vector<Rating>& ratings) {
  if (ratings.empty()) return;
  requireOneSheet(ratings);
  const Rating& first = ratings.front();
  SqlConnection& connection = store.connection();
  SqlTransaction transaction(connection);
  if (connection
          .query("SELECT 1 FROM trials WHERE session=$1 AND number=$2",
                 {first.session, first.number})
          .empty())
    throw UsageError("is not in the " + store.place(),
                     "trial " + std::to_string(first.number) + " of session " + first.session,
                     "Bring the session into the records first: palpa records add");
  connection.query("DELETE FROM ratings WHERE session=$1 AND number=$2 AND rater=$3 AND form=$4",
                   {first.session, first.number, first.rater, first.form});
  for (const Rating& r : ratings)
    connection.query(
        "INSERT INTO ratings(" + columnsOf("ratings") + ") VALUES($1,$2,$3,$4,$5,$6,$7,$8)",
        {r.session, r.number, r.rater, r.form, r.form_sha256, r.item, r.value, r.entered_utc});
  transaction.commit();
}

std::vector<Rating> ratingsIn(RecordStore& store, const std::string& session) {
  const std::string where = session.empty() ? "" : " WHERE session=$1";
  const SqlRows rows = store.connection().query(
      "SELECT " + columnsOf("ratings") + " FROM ratings" + where +
          " ORDER BY session,number,rater,form,item",
      session.empty() ? std::vector<SqlValue>{} : std::vector<SqlValue>{session});
  std::vector<Rating> all;
  for (std::size_t i = 0; i < rows.size(); ++i)
    all.push_back({rows.text(i, 0), rows.integer(i, 1), rows.text(i, 2), rows.text(i, 3),
                   rows.text(i, 4), rows.text(i, 5), rows.integer(i, 6), rows.text(i, 7)});
  return all;
}

}  // namespace palpa::record
