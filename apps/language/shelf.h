#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "apps/language/languages.h"

namespace palpa::language {

/// The languages of a program that speaks to several people at once, each read when it is asked for
/// first. Any thread.
class Shelf {
 public:
  explicit Shelf(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Throws UsageError for one that is not there.
  std::shared_ptr<const Spoken> of(const std::string& code);
  std::vector<Language> all() const { return languagesIn(folder_); }
  /// `chosen` where it is one of ours; else the first of a browser's (RFC 9110, Accept-Language)
  /// that is; else "en".
  std::string best(const std::string& chosen, std::string_view accepted) const;
  /// For a page that says texts itself: {"code", "name", "reviewed", "fromRight", "point", "group",
  /// "messages": [[message, translation], ...]}.
  std::string catalogueJson(const std::string& code) const;

 private:
  const std::filesystem::path folder_;
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const Spoken>> read_;
};

}  // namespace palpa::language
