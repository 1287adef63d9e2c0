#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "apps/language/phrasebook.h"

namespace palpa::language {

/// A language that the program speaks, as its catalogue's header says.
struct Language {
  std::string code;         ///< "el"
  std::string name;         ///< in itself: "Ελληνικά"
  bool reviewed = false;    ///< by a person
  bool from_right = false;  ///< written from right to left
};

/// A language with its messages, as they are written.
struct Catalogue : Language {
  NumberForm numbers;
  std::vector<PoFile::Message> messages;
};

/// A language ready to be spoken.
struct Spoken : Language {
  Phrasebook book;
};

/// English, and those that have a catalogue CODE.po in `folder`, by their codes. Throws Error.
std::vector<Language> languagesIn(const std::filesystem::path& folder);

/// "en" is there always; "qps" and "qps-rtl" are made of the messages alone, to try the layout: a
/// third longer, with marks on every letter, the second from right to left. Both throw UsageError
/// for a language that is not there.
Catalogue catalogueOf(const std::filesystem::path& folder, const std::string& code);
Spoken languageOf(const std::filesystem::path& folder, const std::string& code);

/// What somebody wishes to read: `given` (of a command line) where there is one, else the first
/// language of LANGUAGE, LC_ALL, LC_MESSAGES or LANG ("el_GR.UTF-8") that `folder` has, else "en".
std::string wishedLanguage(const std::filesystem::path& folder, const std::string& given);

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

/// What this process says to people in its window, and what it writes for people on the terminal
/// and in pages; as the locale of the C library these are the process's: chosen once, before its
/// threads begin. Until then English. They differ where a console reads what is written: it says it
/// to each of its guests in his language.
const Spoken& spoken();
const Spoken& written();
void speak(Spoken language);
void write(Spoken language);

}  // namespace palpa::language
