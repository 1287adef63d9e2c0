#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

/// Every kind of file that the program reads, for those who damage them: beside those of kinds.h
/// the ones that have no schema.
namespace palpa::schemas {

struct WholeSample {
  std::string file;  ///< where it lies, under a copy of assets/
  std::string bytes;
};

struct FileKind {
  std::string name;
  std::vector<WholeSample> samples;
  std::function<void(const std::filesystem::path&)> read;  ///< throws for what is refused
  /// Renews a checksum after damage; empty: there is none.
  std::function<std::string(const std::string& bytes)> seal = {};
  bool is_folder = false;   ///< is read together with what lies beside it
  bool has_places = false;  ///< what is wrong is said of a field, a line or a row
};

inline void PrintTo(const FileKind& kind, std::ostream* out) { *out << kind.name; }

std::vector<FileKind> everyFileKind();

}  // namespace palpa::schemas
