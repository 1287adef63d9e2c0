#include "apps/cli/values.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <regex>
#include <sstream>

#include "anatomy/base/error.h"
#include "anatomy/base/nearest_word.h"
#include "apps/station/assets.h"

namespace palpa::cli {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kMostQuoted = 60;

/// The whole text as a number of this type; of whole ones only as it is written in decimal.
template <class T>
std::optional<T> numberIn(const std::string& text) {
  T value{};
  const char* end = text.data() + text.size();
  const auto [stop, problem] = std::from_chars(text.data(), end, value);
  if (problem != std::errc() || stop != end) return std::nullopt;
  if constexpr (std::is_integral_v<T>)
    return std::to_string(value) == text ? std::optional(value) : std::nullopt;
  else
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::string plainly(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string refused(const std::string& needed, const std::string& typed) {
  return "needs " + needed + ", not " + quoted(typed);
}

/// `described`: what the manual and the shell's completion read; see command_tree.
template <class Accept>
CLI::Validator numbers(const std::string& needed, const std::string& described, Accept accept) {
  return {[needed, accept](const std::string& typed) {
            return accept(typed) ? std::string() : refused(needed, typed);
          },
          described};
}

}  // namespace

CLI::Validator inRange(int low, int high) {
  const std::string ends = std::to_string(low), other = std::to_string(high);
  return numbers("a whole number between " + ends + " and " + other,
                 "[" + ends + " - " + other + "]", [low, high](const std::string& typed) {
                   const auto value = numberIn<int>(typed);
                   return value && *value >= low && *value <= high;
                 });
}

CLI::Validator atLeastZero() {
  return numbers("a whole number of 0 or more", "", [](const std::string& typed) {
    return numberIn<std::uint64_t>(typed).has_value();
  });
}

CLI::Validator moreThanZero() {
  return numbers("a whole number of 1 or more", "", [](const std::string& typed) {
    return numberIn<std::uint64_t>(typed).value_or(0) > 0;
  });
}

CLI::Validator inRange(double low, double high, const std::string& unit) {
  return numbers("a number between " + plainly(low) + " and " + plainly(high) +
                     (unit.empty() ? "" : " " + unit),
                 "[" + plainly(low) + " - " + plainly(high) + "]",
                 [low, high](const std::string& typed) {
                   const auto value = numberIn<double>(typed);
                   return value && *value >= low && *value <= high;
                 });
}

CLI::Validator notNegative(const std::string& unit) {
  return numbers(
      "a number of 0 " + (unit.empty() ? "" : unit + " ") + "or more", "",
      [](const std::string& typed) { return numberIn<double>(typed).value_or(-1) >= 0; });
}

CLI::Validator aNumber() {
  return numbers("a number", "",
                 [](const std::string& typed) { return numberIn<double>(typed).has_value(); });
}

namespace {

std::string choicesOf(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ",") + word;
  return "{" + all + "}";
}

bool isAmong(const std::vector<std::string>& words, const std::string& typed) {
  return std::find(words.begin(), words.end(), typed) != words.end();
}

std::vector<std::string> namesIn(const fs::path& folder, const fs::path& extension) {
  std::vector<std::string> names;
  std::error_code unreadable;
  for (fs::directory_iterator at(folder, unreadable), end; !unreadable && at != end;
       at.increment(unreadable))
    if (extension.empty() || at->path().extension() == extension)
      names.push_back(at->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

fs::path shippedFolder(const std::string& name) {
  try {
    return name.empty() ? fs::path() : station::assetFile(name);
  } catch (const Error&) {  // nothing to propose from
    return {};
  }
}

/// The path that was probably meant, first of all beside what was typed; empty: none.
std::string nearestPath(const fs::path& typed, const fs::path& shipped) {
  const fs::path beside = typed.has_parent_path() ? typed.parent_path() : fs::path(".");
  for (const fs::path& folder : {beside, shipped}) {
    if (folder.empty()) continue;
    const std::vector<std::string> names = namesIn(folder, typed.extension());
    const auto near = nearestWord(typed.filename().string(), names);
    if (near) return (folder == "." ? fs::path(*near) : folder / *near).string();
  }
  return "";
}

bool isThere(const std::string& name) {
  std::error_code unreadable;
  return fs::exists(name, unreadable);
}

}  // namespace

CLI::Validator oneOf(std::vector<std::string> words) {
  const std::string described = choicesOf(words);
  return {[words = std::move(words)](const std::string& typed) {
            if (isAmong(words, typed)) return std::string();
            return refused(listed(words), typed) + proposal(typed, words);
          },
          described};
}

CLI::Validator oneOfOrFile(std::vector<std::string> words) {
  const std::string described = choicesOf(words);
  return {[words = std::move(words)](const std::string& typed) {
            std::error_code unreadable;
            if (words.empty() || isAmong(words, typed) || fs::is_regular_file(typed, unreadable))
              return std::string();
            return refused(listed(words, "") + " or a file that is there", typed) +
                   proposal(typed, words);
          },
          described};
}

CLI::Validator writtenAs(const std::string& pattern, const std::string& needs) {
  return {[form = std::regex(pattern), needs](const std::string& typed) {
            return std::regex_match(typed, form) ? std::string() : refused(needs, typed);
          },
          ""};
}

std::vector<std::string> shippedNames(const std::string& folder) {
  std::vector<std::string> names = namesIn(shippedFolder(folder), ".json");
  for (std::string& name : names) name = fs::path(name).stem().string();
  return names;
}

CLI::Validator somethingThere(const std::string& shipped) {
  return {[shipped](const std::string& typed) {
            if (isThere(typed)) return std::string();
            const std::string near = nearestPath(typed, shippedFolder(shipped));
            return refused("a file that is there", typed) +
                   (near.empty() ? "" : "; did you mean " + near + "?");
          },
          ""};
}

std::string listed(const std::vector<std::string>& words, const std::string& last) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool ends = i + 1 == words.size() && !last.empty();
    text += (i == 0 ? "" : ends ? " " + last + " " : ", ") + words[i];
  }
  return text;
}

std::string quoted(const std::string& typed) {
  if (typed.size() <= kMostQuoted) return "'" + typed + "'";
  std::size_t end = kMostQuoted;
  while (end > 0 && (static_cast<unsigned char>(typed[end]) & 0xC0) == 0x80) --end;
  return "'" + typed.substr(0, end) + "...'";
}

std::string proposal(const std::string& typed, const std::vector<std::string>& known) {
  const auto near = nearestWord(typed, known);
  return near ? "; did you mean " + *near + "?" : "";
}

}  // namespace palpa::cli
