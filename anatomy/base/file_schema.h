#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "anatomy/base/json_file.h"

/// The published schemas (assets/schemas), built into the program: the one place that says which
/// fields a kind of file may have.
namespace palpa {

struct SchemaText {
  std::string_view kind, text;  ///< kind: "station", "task_needle", "common", ...
};
/// Of every schema; the build makes the source from assets/schemas.
std::span<const SchemaText> schemaTexts();

/// Walks through a file and the schema of its kind side by side and throws UsageError at the first
/// field that the schema does not name: which, where, and what was probably meant. Branches of a
/// schema (if, anyOf, ...) count together: whether a field fits the others is the reader's
/// question. `kind` must be one of schemaTexts().
void refuseUnknownFields(const JsonFile& file, std::string_view kind);

/// The names of fields that a schema knows at a place of a file, "device" or "device/other".
std::vector<std::string> fieldsOf(std::string_view kind, const std::string& place);

/// What every reader asks first: the file's version is 1 to `newest`, and it has no unknown field.
/// Returns the version. Fields of a later version are not called mistakes: the version is.
int needKind(const JsonFile& file, std::string_view kind, int newest);

}  // namespace palpa
