#include "apps/link/data_tables.h"

#include <algorithm>
#include <map>
#include <set>
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

ExportTable furtherTable(
    const std::string& name, const std::vector<std::string>& columns,
    std::function<void(const std::function<void(const std::vector<record::SqlValue>&)>&)> rows) {
  ExportTable table{name, "One row each, as the records keep it", {}, {}};
  for (const std::string& column : columns) {
    const auto known = kMeanings.find(column);
    table.columns.push_back(
        {column, known == kMeanings.end() ? "text" : known->second.unit,
         known == kMeanings.end() ? "as the records keep it" : known->second.text, "",
         "not given"});
  }
  table.rows = [rows = std::move(rows)](const RowVisitor& visit) {
    rows([&](const std::vector<record::SqlValue>& values) {
      TableRow row;
      for (const record::SqlValue& value : values) row.push_back(cellOf(value));
      visit(row);
    });
  };
  return table;
}

std::vector<ExportTable> furtherTables(const ExportSource& source) {
  std::vector<ExportTable> all;
  for (const std::string& name : record::tableNames()) {
    const std::vector<std::string> columns = columnsIn(name);
    const auto whose = std::find(columns.begin(), columns.end(), "trainee");
    if (name == "sessions" || whose == columns.end()) continue;
    const auto at = static_cast<std::size_t>(whose - columns.begin());
    all.push_back(furtherTable(name, columns, [&source, name, at](const auto& visit) {
      std::set<std::string> chosen;
      for (const record::Trainee& t : source.who) chosen.insert(t.id);
      const std::string& names = record::columnsOf(name);
      const auto rows =
          source.records.cursor("SELECT " + names + " FROM " + name + " ORDER BY trainee," + names);
      while (rows->next())
        if (chosen.contains(std::string(rows->text(at)))) visit(rows->row());
    }));
  }
  return all;
}

}  // namespace palpa::link
