#include "apps/link/data_tables.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "apps/record/store/migrations.h"

namespace palpa::link {
namespace {

struct Meaning {
  const char *unit, *text;
};

const std::map<std::string, Meaning> kMeanings{
    {"study", {"text", "id of the study"}},
    {"trainee", {"text", "pseudonym"}},
    {"group_name", {"text", "group of the study"}},
    {"place", {"1", "1, 2, ... in this group, by enrolment"}},
    {"condition", {"text", "condition of the study"}},
    {"simulated", {"0 or 1", "1: no person"}},
    {"enrolled_utc", {"UTC", "when the trainee got this place"}},
    {"session", {"1", "session of the study, 1, 2, ..."}},
    {"item", {"text", "id of the question"}},
    {"questionnaire", {"text", "id of the questionnaire"}},
    {"answer", {"text", "as it was given"}},
    {"answered_utc", {"UTC", "when it was answered"}}};

std::vector<std::string> columnsIn(const std::string& table) {
  std::vector<std::string> columns;
  std::istringstream names(record::columnsOf(table));
  for (std::string name; std::getline(names, name, ',');) columns.push_back(name);
  return columns;
}

nlohmann::json cellOf(const record::SqlValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole;
  if (const auto* real = std::get_if<double>(&value)) return *real;
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return nullptr;
}

}  // namespace

std::vector<FurtherTable> furtherTables(record::RecordStore& store,
                                        const std::vector<record::Trainee>& who) {
  std::vector<FurtherTable> all;
  for (const std::string& name : record::tableNames()) {
    FurtherTable table{name, columnsIn(name), {}};
    if (name == "sessions" ||
        std::find(table.columns.begin(), table.columns.end(), "trainee") == table.columns.end())
      continue;
    for (const record::Trainee& person : who) {
      const record::SqlRows rows =
          store.connection().query("SELECT " + record::columnsOf(name) + " FROM " + name +
                                       " WHERE trainee=$1 ORDER BY " + record::columnsOf(name),
                                   {person.id});
      for (std::size_t i = 0; i < rows.size(); ++i) table.rows.push_back(rows.row(i));
    }
    all.push_back(std::move(table));
  }
  return all;
}

ExportTable asTable(const FurtherTable& further) {
  ExportTable table{further.name, "One row each, as the records keep it", {}, {}};
  for (const std::string& name : further.columns) {
    const auto known = kMeanings.find(name);
    table.columns.push_back(
        {name, known == kMeanings.end() ? "text" : known->second.unit,
         known == kMeanings.end() ? "as the records keep it" : known->second.text, "",
         "not given"});
  }
  for (const auto& row : further.rows) {
    table.rows.emplace_back();
    for (const record::SqlValue& value : row) table.rows.back().push_back(cellOf(value));
  }
  return table;
}

}  // namespace palpa::link
