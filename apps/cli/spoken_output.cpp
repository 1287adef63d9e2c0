#include "apps/cli/spoken_output.h"

#include <algorithm>
#include <cstdio>

#include "anatomy/base/error.h"
#include "apps/language/languages.h"
#include "apps/station/assets.h"
#include "scene/scene_state.h"

namespace palpa::cli {
namespace {

constexpr char kOption[] = "--language";
constexpr std::size_t kBuffer = 1 << 16;  // bytes: no line of ours is cut

/// Objects and lists are for programs.
bool isForPeople(std::string_view line) {
  const std::size_t first = line.find_first_not_of(' ');
  return first != std::string_view::npos &&
         std::string_view("{}[]\"").find(line[first]) == std::string_view::npos;
}

/// The stream that it stands before gets all, line by line as far as it is there.
ssize_t say(void* before, const char* text, std::size_t size) {
  std::string out;
  for (std::string_view rest(text, size); !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size() - 1) + 1;
    const std::string_view line = rest.substr(0, end);
    out += isForPeople(line) ? language::written().book.said(line) : std::string(line);
    rest.remove_prefix(end);
  }
  FILE* const stream = static_cast<FILE*>(before);
  const bool went = std::fwrite(out.data(), 1, out.size(), stream) == out.size();
  return went && std::fflush(stream) == 0 ? static_cast<ssize_t>(size) : 0;
}

FILE* spoken(FILE* stream) {
  std::fflush(stream);
  FILE* const before = fopencookie(stream, "w", {nullptr, say, nullptr, nullptr});
  if (!before) return stream;
  std::setvbuf(before, nullptr, _IOLBF, kBuffer);
  return before;
}

void speakOnTheTerminal() {
  stdout = spoken(stdout);
  stderr = spoken(stderr);
}

}  // namespace

std::string takeLanguage(std::vector<std::string>* words) {
  std::string given;
  for (auto word = words->begin(); word != words->end();) {
    const bool joined = word->starts_with(std::string(kOption) + "=");
    if (!joined && *word != kOption) {
      ++word;
      continue;
    }
    const auto value = joined ? word : word + 1;
    if (value == words->end() || (!joined && value->starts_with('-')))
      throw UsageError("lacks its language", kOption, "Give one, such as --language el");
    given = joined ? value->substr(sizeof kOption) : *value;
    word = words->erase(word, value + 1);
  }
  return given;
}

void speakTo(const std::vector<std::string>& words, const std::string& given) {
  std::filesystem::path folder;
  try {
    folder = station::assetFile("languages");
  } catch (const Error&) {
    if (!given.empty()) throw;
    return;  // English will say what is wrong
  }
  const std::string code = language::wishedLanguage(folder, given);
  const bool is_read = std::find(words.begin(), words.end(), "--live") != words.end();
  language::speak(language::languageOf(folder, code));
  if (language::spoken().book.isEnglish()) return;
  scene::sayThrough([](const std::string& text) { return language::spoken().book.said(text); });
  if (is_read) return;
  language::write(language::languageOf(folder, code));
  speakOnTheTerminal();
}

}  // namespace palpa::cli
