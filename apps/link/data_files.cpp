#include "apps/link/data_tables.h"

#include <optional>

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

std::string csvHeader(const ExportTable& table) {
  std::string text;
  for (const TableColumn& c : table.columns) text += (text.empty() ? "" : ",") + csvField(c.name);
  return text + '\n';
}

std::string csvLine(const TableRow& row) {
  std::string text;
  for (std::size_t i = 0; i < row.size(); ++i) text += (i > 0 ? "," : "") + cellText(row[i]);
  return text + '\n';
}

constexpr char kJsonBegins[] = "{\n \"format\": \"palpa records\",\n \"version\": 1",
               kJsonEnds[] = "\n}\n";

/// A table within the object: ",\n \"trials\": [" and its rows.
class JsonRows {
 public:
  JsonRows(const ExportTable& table, TextSink sink) : sink_(std::move(sink)) {
    for (const TableColumn& c : table.columns) names_.push_back(asText(c.name));
    sink_(",\n " + asText(table.name) + ": [");
  }
  void add(const TableRow& row) {
    std::string text = first_ ? "\n  {" : ",\n  {";
    for (std::size_t i = 0; i < row.size(); ++i)
      text += (i > 0 ? ",\n   " : "\n   ") + names_[i] + ": " + indented(row[i]);
    sink_(text + "\n  }");
    first_ = false;
  }
  void finish() { sink_(first_ ? "]" : "\n ]"); }

 private:
  static std::string indented(const json& cell) {
    if (!cell.is_structured()) return asText(cell);
    std::string text;
    for (const char c : cell.dump(1, ' ', false, json::error_handler_t::replace))
      c == '\n' ? text += "\n   " : text += c;
    return text;
  }
  TextSink sink_;
  std::vector<std::string> names_;
  bool first_ = true;
};

}  // namespace

void writeCsv(const ExportTable& table, const TextSink& sink) {
  sink(csvHeader(table));
  table.rows([&](const TableRow& row) { sink(csvLine(row)); });
}

void writeJson(const std::vector<ExportTable>& tables, const TextSink& sink) {
  sink(kJsonBegins);
  for (const ExportTable& table : tables) {
    JsonRows rows(table, sink);
    table.rows([&](const TableRow& row) { rows.add(row); });
    rows.finish();
  }
  sink(kJsonEnds);
}

ExportTable dictionaryOf(const std::vector<ExportTable>& tables) {
  ExportTable dictionary{"dictionary", "What every column is", {}, {}};
  for (const char* name : {"table", "column", "unit", "meaning", "better", "empty_when"})
    dictionary.columns.push_back({name, "text", "", "", ""});
  std::vector<TableRow> rows;
  for (const ExportTable& table : tables)
    for (const TableColumn& c : table.columns)
      rows.push_back({table.name, c.name, c.unit, c.meaning, c.better, c.missing});
  dictionary.rows = [rows = std::move(rows)](const RowVisitor& visit) {
    for (const TableRow& row : rows) visit(row);
  };
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

namespace {

TextSink into(WholeFile& file) {
  return [&file](std::string_view text) { file.write(text); };
}

/// Each table is read once, whatever is written of it.
void writeData(const std::vector<ExportTable>& tables, WholeFile* json_file, bool csv,
               const std::filesystem::path& folder) {
  if (json_file) json_file->write(kJsonBegins);
  for (const ExportTable& table : tables) {
    std::optional<WholeFile> csv_file;
    std::optional<JsonRows> json_rows;
    if (csv) csv_file.emplace(folder / (table.name + ".csv"));
    if (csv) csv_file->write(csvHeader(table));
    if (json_file) json_rows.emplace(table, into(*json_file));
    table.rows([&](const TableRow& row) {
      if (csv_file) csv_file->write(csvLine(row));
      if (json_rows) json_rows->add(row);
    });
    if (csv_file) csv_file->finish();
    if (json_rows) json_rows->finish();
  }
  if (json_file) json_file->write(kJsonEnds);
}

}  // namespace

std::vector<std::string> writeTables(const std::vector<ExportTable>& tables, DataFormat format,
                                     const std::filesystem::path& folder) {
  std::vector<std::string> written;
  const bool csv = format != DataFormat::json;
  std::optional<WholeFile> json_file;
  if (format != DataFormat::csv) json_file.emplace(folder / "records.json");
  writeData(tables, json_file ? &*json_file : nullptr, csv, folder);
  if (csv)
    for (const ExportTable& table : tables) written.push_back(table.name + ".csv");
  if (json_file) {
    json_file->finish();
    written.emplace_back("records.json");
  }
  WholeFile dictionary(folder / "dictionary.csv");
  writeCsv(dictionaryOf(tables), into(dictionary));
  dictionary.finish();
  writeWhole(folder / "dictionary.md", dictionaryAsMarkdown(tables));
  written.insert(written.end(), {"dictionary.csv", "dictionary.md"});
  return written;
}

}  // namespace palpa::link
