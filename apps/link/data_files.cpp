#include "apps/link/data_tables.h"

#include "anatomy/base/text_forms.h"
#include "anatomy/base/whole_file.h"

namespace palpa::link {
namespace {

using nlohmann::json;

/// What is no UTF-8 must not lose a whole file.
std::string asText(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string cellText(const json& cell) {
  if (cell.is_null()) return "";
  return csvField(cell.is_string() ? cell.get<std::string>() : asText(cell));
}

/// A bar would end the cell.
std::string forMarkdown(const json& cell) {
  std::string text;
  if (cell.is_string())
    for (const char c : cell.get<std::string>())
      text += c == '|' ? std::string("\\|") : std::string(1, c);
  return text;
}

}  // namespace

std::string asCsv(const ExportTable& table) {
  std::string text;
  const auto line = [&text](std::size_t count, const auto& cell) {
    for (std::size_t i = 0; i < count; ++i) text += (i > 0 ? "," : "") + cell(i);
    text += '\n';
  };
  line(table.columns.size(), [&](std::size_t i) { return csvField(table.columns[i].name); });
  for (const auto& row : table.rows)
    line(row.size(), [&](std::size_t i) { return cellText(row[i]); });
  return text;
}

std::string asJson(const std::vector<ExportTable>& tables) {
  nlohmann::ordered_json all{{"format", "palpa records"}, {"version", 1}};
  for (const ExportTable& table : tables) {
    auto& rows = all[table.name] = nlohmann::ordered_json::array();
    for (const auto& row : table.rows) {
      nlohmann::ordered_json object = nlohmann::ordered_json::object();
      for (std::size_t i = 0; i < row.size(); ++i) object[table.columns[i].name] = row[i];
      rows.push_back(std::move(object));
    }
  }
  return all.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

ExportTable dictionaryOf(const std::vector<ExportTable>& tables) {
  ExportTable dictionary{"dictionary", "What every column is", {}, {}};
  for (const char* name : {"table", "column", "unit", "meaning", "better", "empty_when"})
    dictionary.columns.push_back({name, "text", "", "", ""});
  for (const ExportTable& table : tables)
    for (const TableColumn& c : table.columns)
      dictionary.rows.push_back({table.name, c.name, c.unit, c.meaning, c.better, c.missing});
  return dictionary;
}

std::string dictionaryAsMarkdown(const std::vector<ExportTable>& tables) {
  std::string text =
      "# Data dictionary\n\nFields are separated by commas, the point is decimal, times are UTC. "
      "An empty field: does not apply. People are known by pseudonym; `simulated` 1 is no person's "
      "performance on a real station.\n";
  for (const ExportTable& table : tables) {
    text +=
        "\n## " + table.name + ".csv\n\n" + table.meaning +
        ".\n\n| column | unit | meaning | better | empty when |\n| --- | --- | --- | --- | --- |\n";
    for (const TableColumn& c : table.columns) {
      text += "|";
      for (const std::string& cell : {c.name, c.unit, c.meaning, c.better, c.missing})
        text += " " + forMarkdown(cell) + " |";
      text += "\n";
    }
  }
  return text;
}

std::vector<std::string> writeTables(const std::vector<ExportTable>& tables, DataFormat format,
                                     const std::filesystem::path& folder) {
  std::vector<std::string> written;
  const auto write = [&](const std::string& name, const std::string& text) {
    writeWhole(folder / name, text);
    written.push_back(name);
  };
  if (format != DataFormat::json)
    for (const ExportTable& table : tables) write(table.name + ".csv", asCsv(table));
  if (format != DataFormat::csv) write("records.json", asJson(tables));
  write("dictionary.csv", asCsv(dictionaryOf(tables)));
  write("dictionary.md", dictionaryAsMarkdown(tables));
  return written;
}

}  // namespace palpa::link
