#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace palpa::report {

/// What somebody did and how it was judged, on one sheet to sign. It says what it does not certify.
struct Certificate {
  std::string task;        ///< "Access to the subclavian vein, right side"
  bool simulated = false;  ///< operator or bench are: said on top
  /// Who, when, by whom it was judged, on what: name and value.
  std::vector<std::pair<std::string, std::string>> facts;
  std::vector<std::string> judged;  ///< sentences: checklist, grades, errors
  std::vector<std::string> limits;  ///< sentences: what this does not show
  std::string made_by;              ///< "palpa 0.1.0, session 1a2b3c4d"
};

/// A PDF of one A4 sheet; all or nothing. The same input gives the same words, not the same bytes:
/// the library writes the date into it. Throws Error.
void writeCertificate(const Certificate& certificate, const std::filesystem::path& file);

}  // namespace palpa::report
