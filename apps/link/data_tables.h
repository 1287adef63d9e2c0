#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/record/store/record_reading.h"

namespace palpa::link {

/// Whose records are written, and where from. Tables read them row by row, so while they are
/// written the connection is within a transaction for reading: all tables are of its moment.
struct ExportSource {
  record::SqlConnection& records;
  std::vector<record::Trainee> who;  ///< by id
  bool with_paths = false;           ///< with places of this computer: where evidence lies
};

/// How much that is.
struct Extent {
  std::size_t sessions = 0, simulated = 0, trials = 0;  ///< simulated: of the sessions
};
Extent extentOf(const ExportSource& source);

/// What a column holds.
struct TableColumn {
  std::string name;
  std::string unit;  ///< "text", "UTC", "0 or 1", "JSON"; "1": a plain number
  std::string meaning;
  std::string better;   ///< "lower", "higher"; empty: neither
  std::string missing;  ///< when a cell is empty; empty: never
};

using TableRow = std::vector<nlohmann::json>;  ///< null: empty
using RowVisitor = std::function<void(const TableRow&)>;

/// What it has columns for it reads when its rows are asked for, each time anew; no more than one
/// row is held.
struct ExportTable {
  std::string name, meaning;
  std::vector<TableColumn> columns;
  std::function<void(const RowVisitor&)> rows;
};

/// trainees, sessions, calibrations, trials (with every figure that this program knows or the
/// records hold), events; everything else that the store keeps about a person. People appear by
/// pseudonym. The source must outlive the tables.
std::vector<ExportTable> tablesOf(const ExportSource& source);

/// Every table of the store, but those that are exported by name, that says whose each row is: a
/// person's export has everything, whatever the store learnt to keep.
std::vector<ExportTable> furtherTables(const ExportSource& source);
/// One of them, by its columns as the store names them.
ExportTable furtherTable(
    const std::string& name, const std::vector<std::string>& columns,
    std::function<void(const std::function<void(const std::vector<record::SqlValue>&)>&)> rows);

/// Text goes on there, piece by piece.
using TextSink = std::function<void(std::string_view)>;

/// RFC 4180, a header row, lines end with LF; the same in every locale. JSON cells are JSON texts.
void writeCsv(const ExportTable& table, const TextSink& sink);
/// All tables in one object, each a list of rows by column name.
void writeJson(const std::vector<ExportTable>& tables, const TextSink& sink);
/// What every column of every table is: as a table itself, and for people.
ExportTable dictionaryOf(const std::vector<ExportTable>& tables);
std::string dictionaryAsMarkdown(const std::vector<ExportTable>& tables);

enum class DataFormat { csv, json, both };

/// <table>.csv, records.json; dictionary.csv and dictionary.md beside them. Answers with the files'
/// names. Throws Error.
std::vector<std::string> writeTables(const std::vector<ExportTable>& tables, DataFormat format,
                                     const std::filesystem::path& folder);

}  // namespace palpa::link
