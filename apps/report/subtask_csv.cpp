#include "apps/report/subtask_csv.h"

#include <algorithm>

#include "apps/report/numbers.h"

namespace palpa::report {
namespace {

/// "shape assessment" -> "SHAPE_ASSESSMENT".
std::string columnName(const std::string& subtask) {
  std::string column;
  for (const char c : subtask) {
    const bool small = c >= 'a' && c <= 'z',
               plain_character = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    column += small ? static_cast<char>(c - 'a' + 'A') : plain_character ? c : '_';
  }
  return column;
}

}  // namespace

std::string subtaskColumns(const std::vector<assess::SubtaskDose>& parts) {
  std::string columns;
  for (const assess::SubtaskDose& part : parts)
    for (const char* what : {"_ON_S", "_TIMES", "_AUGMENTED_S", "_IMPULSE_NS"})
      columns += ',' + columnName(part.subtask) + what;
  return columns;
}

std::string subtaskFields(const std::vector<assess::SubtaskDose>& parts,
                          const std::vector<assess::SubtaskDose>& doses) {
  std::string fields;
  for (const assess::SubtaskDose& part : parts) {
    const auto dose = std::find_if(doses.begin(), doses.end(), [&](const assess::SubtaskDose& d) {
      return d.subtask == part.subtask;
    });
    fields += dose == doses.end()
                  ? ",,,,"
                  : ',' + shortest(dose->on_s) + ',' + std::to_string(dose->times) + ',' +
                        shortest(dose->augmented_s) + ',' + shortest(dose->impulse_Ns);
  }
  return fields;
}

}  // namespace palpa::report
