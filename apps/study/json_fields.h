#pragma once

#include <string>

#include "anatomy/base/json_file.h"
#include "apps/record/store/record_store.h"

namespace palpa::study {

/// true or false; `otherwise` where the field is missing. Throws UsageError.
inline bool flag(const station::JsonFile& file, const std::string& field, bool otherwise) {
  if (!file.has(field)) return otherwise;
  const nlohmann::json& value = file.json().at(field);
  if (!value.is_boolean()) file.refuse(field, "must be true or false");
  return value.get<bool>();
}

/// A short word that stands in files, tables and folders: as a pseudonym, 1 to 32 letters, digits,
/// - or _. Throws UsageError.
inline std::string needName(const station::JsonFile& file, const std::string& field) {
  const std::string name = file.text(field);
  if (!record::whyNoPseudonym(name).empty())
    file.refuse(field, "is \"" + name + "\"; a name here has 1 to 32 letters, digits, - or _");
  return name;
}

}  // namespace palpa::study
