#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "anatomy/base/error.h"

namespace palpa {

/// An object of a JSON file that nobody vouches for: every field is asked for once, `done` refuses
/// what nobody asked for, a text "$schema" of the whole file apart: an editor's. Messages name file
/// and field ("entries[3].unit"), and what was probably meant by another name.
class JsonFields {
 public:
  JsonFields(const nlohmann::json& object, std::string file, std::string path);

  [[noreturn]] void refuse(const std::string& field, const std::string& what) const;
  const std::string& file() const { return file_; }
  std::string pathOf(const std::string& field) const {
    return path_.empty() ? field : path_ + "." + field;
  }

  const nlohmann::json* find(const std::string& field);  ///< nullptr when absent
  const nlohmann::json& need(const std::string& field);
  std::string text(const std::string& field);  ///< not empty, at most 2000 bytes
  std::string textOr(const std::string& field, const std::string& otherwise);
  double numberOr(const std::string& field, double otherwise, double least, double most);
  bool flagOr(const std::string& field, bool otherwise);
  /// Three numbers of at most this size.
  std::array<double, 3> triple(const std::string& field, double most);
  void done() const;

 private:
  /// By which field that nobody has asked for a missing one was probably meant; empty: by none.
  std::string meantBy(const std::string& field) const;

  const nlohmann::json& object_;
  std::string file_, path_;
  std::set<std::string> asked_;
};

/// A key as a message can hold it: control characters and what is no UTF-8 escaped.
std::string printable(const std::string& key);

/// Parses text of at most 4 MiB that is not nested deeper than 16. Throws UsageError.
nlohmann::json parseJson(const std::string& text, const std::string& file);

}  // namespace palpa
