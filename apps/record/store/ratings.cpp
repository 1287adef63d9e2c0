#include "apps/record/store/ratings.h"

#include <algorithm>

#include "apps/record/store/migrations.h"

namespace palpa::record {
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
