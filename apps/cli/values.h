#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

/// What a value given on the command line may be. Each refuses in words that begin "needs ..." and
/// hold what was typed; the option's name is put before them (usage_words.h).
namespace palpa::cli {

/// A whole number, written in decimal digits (no 010, 0x10 or 1e3).
CLI::Validator inRange(int low, int high);
CLI::Validator atLeastZero();   ///< up to 2^64 - 1
CLI::Validator moreThanZero();  ///< likewise

/// A number with a decimal point, finite. `unit`: as in "between 0.2 and 3 m".
CLI::Validator inRange(double low, double high, const std::string& unit = "");
CLI::Validator notNegative(const std::string& unit = "");
CLI::Validator aNumber();

/// One of these words; the nearest one is proposed.
CLI::Validator oneOf(std::vector<std::string> words);
/// One of them, or the name of a file that is there; without words anything.
CLI::Validator oneOfOrFile(std::vector<std::string> words);

/// Written so (a regular expression); `needs`: in words, after "needs".
CLI::Validator writtenAs(const std::string& pattern, const std::string& needs);

/// What the files in a folder of the assets are called, without extension; sorted.
std::vector<std::string> shippedNames(const std::string& folder);

/// A file or folder that is there. Proposed is one of nearly that name beside it, or of those that
/// come with the program, in the assets' folder `shipped`.
CLI::Validator somethingThere(const std::string& shipped);

template <class Map>
std::vector<std::string> keysOf(const Map& map) {
  std::vector<std::string> keys;
  for (const auto& [key, ignored] : map) keys.push_back(key);
  return keys;
}

/// "a, b or c".
std::string listed(const std::vector<std::string>& words, const std::string& last = "or");

/// What was typed, between marks, cut where it is long.
std::string quoted(const std::string& typed);

/// "; did you mean NEAR?", empty where none of `known` is near.
std::string proposal(const std::string& typed, const std::vector<std::string>& known);

}  // namespace palpa::cli
