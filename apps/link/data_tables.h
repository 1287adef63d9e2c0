#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/record/store/record_store.h"

namespace palpa::link {

/// A further table of the store that names a trainee in each row: places in studies, answers to
/// questionnaires.
struct FurtherTable {
  std::string name;
  std::vector<std::string> columns;
  std::vector<std::vector<record::SqlValue>> rows;
};

/// What the records hold of some people.
struct Dataset {
  std::vector<record::Trainee> trainees;
  std::vector<record::StoredSession> sessions;   ///< with their calibrations
  std::vector<record::TrialWithSession> trials;  ///< with their events
  std::vector<FurtherTable> further = {};
};

Dataset datasetOf(record::RecordStore& store, const std::vector<record::Trainee>& who);

/// What a column holds.
struct TableColumn {
  std::string name;
  std::string unit;  ///< "text", "UTC", "0 or 1", "JSON"; "1": a plain number
  std::string meaning;
  std::string better;   ///< "lower", "higher"; empty: neither
  std::string missing;  ///< when a cell is empty; empty: never
};

struct ExportTable {
  std::string name, meaning;
  std::vector<TableColumn> columns;
  std::vector<std::vector<nlohmann::json>> rows;  ///< null: empty
};

/// trainees, sessions, calibrations, trials (with every figure that this program knows or the
/// records hold), events. People appear by pseudonym, places of this computer (where evidence lies)
/// only `with_paths`.
std::vector<ExportTable> tablesOf(const Dataset& data, bool with_paths);

/// Every table of the store, but those that are exported by name, that says whose each row is: a
/// person's export has everything, whatever the store learnt to keep.
std::vector<FurtherTable> furtherTables(record::RecordStore& store,
                                        const std::vector<record::Trainee>& who);

ExportTable asTable(const FurtherTable& further);

/// RFC 4180, a header row, lines end with LF; the same in every locale. JSON cells are JSON texts.
std::string asCsv(const ExportTable& table);
/// All tables in one object, each a list of rows by column name.
std::string asJson(const std::vector<ExportTable>& tables);
/// What every column of every table is: as a table itself, and for people.
ExportTable dictionaryOf(const std::vector<ExportTable>& tables);
std::string dictionaryAsMarkdown(const std::vector<ExportTable>& tables);

enum class DataFormat { csv, json, both };

/// <table>.csv, records.json; dictionary.csv and dictionary.md beside them. Answers with the files'
/// names. Throws Error.
std::vector<std::string> writeTables(const std::vector<ExportTable>& tables, DataFormat format,
                                     const std::filesystem::path& folder);

}  // namespace palpa::link
