#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/link/data_tables.h"

namespace palpa::link {

/// RFC 4180, a header row, lines end with LF; the same in every locale. JSON cells are JSON texts.
std::string asCsv(const DataTable& table);
/// All tables in one object, each a list of rows by column name.
std::string asJson(const std::vector<DataTable>& tables);
/// What every column of every table is: as a table itself, and for people.
DataTable dictionaryOf(const std::vector<DataTable>& tables);
std::string dictionaryAsMarkdown(const std::vector<DataTable>& tables);

enum class DataFormat { csv, json, both };

/// <table>.csv, records.json; dictionary.csv and dictionary.md beside them. Answers with the files'
/// names. Throws Error.
std::vector<std::string> writeTables(const std::vector<DataTable>& tables, DataFormat format,
                                     const std::filesystem::path& folder);

}  // namespace palpa::link
