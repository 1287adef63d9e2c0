#include "apps/record/store/backup.h"

#include "apps/record/store/migrations.h"

namespace palpa::record {
namespace {

std::string placeholders(std::size_t count) {
  std::string text;
  for (std::size_t i = 1; i <= count; ++i) text += (i > 1 ? ",$" : "$") + std::to_string(i);
  return text;
}

void requireEmpty(SqlConnection& store) {
  for (const std::string& table : tableNames())
    if (!store.query("SELECT 1 FROM " + table + " LIMIT 1").empty())
      throw UsageError("holds records already (" + table + ")", store.place(),
                       "Choose a new file or an empty database; nothing was changed");
}

}  // namespace

std::size_t copyStore(SqlConnection& from, SqlConnection& to) {
  migrate(from);
  migrate(to);
  SqlTransaction reading(from), writing(to);
  from.freeze();
  to.lockSchema();
  requireEmpty(to);
  std::size_t copied = 0;
  for (const std::string& table : tableNames()) {
    const SqlRows rows = from.query("SELECT " + columnsOf(table) + " FROM " + table);
    for (std::size_t r = 0; r < rows.size(); ++r)
      to.query("INSERT INTO " + table + "(" + columnsOf(table) + ") VALUES(" +
                   placeholders(rows.row(r).size()) + ")",
               rows.row(r));
    copied += rows.size();
  }
  writing.commit();
  return copied;
}

}  // namespace palpa::record
