#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/report/html.h"

namespace palpa::report {

/// The figures behind a plot: closed until asked for, the first column names the rows. On paper it
/// stays closed.
struct DataTable {
  std::string title;  ///< "The figures of this plot"
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< as long as `columns`
  std::size_t words_from = SIZE_MAX;           ///< from this column on they are words, not figures
};
void writeDataTable(Html& html, const DataTable& table);

/// The same always open.
void writeOpenTable(Html& html, const DataTable& table);

}  // namespace palpa::report
