#include "forbidden.h"

#include <algorithm>
#include <cctype>

namespace palpa::house {
namespace {

bool isPartOfAName(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

bool contains(const std::string& text, const std::string& word) {
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool joined_before = at > 0 && isPartOfAName(word.front()) && isPartOfAName(text[at - 1]);
    const bool joined_after =
        end < text.size() && isPartOfAName(word.back()) && isPartOfAName(text[end]);
    if (!joined_before && !joined_after) return true;
  }
  return false;
}

// Every word is written in two pieces, so that this file does not hold it.
std::vector<Forbidden> makeForbidden() {
  const std::string chance = "randomness comes from anatomy/base/random.h: same seed, same bits";
  const std::string time = "time comes from Clock (apps/runtime/clock.h)";
  const std::vector<std::string> clocks{"apps/os/system_time.cpp",
                                        "tests/computer_faults/computer_faults.cpp"};
  std::vector<Forbidden> all{
      {"random_"
       "device",
       chance,
       true,
       {}},
      {"ran"
       "d(",
       chance,
       true,
       {}},
      {"sran"
       "d(",
       chance,
       true,
       {}},
      {"-ffast-"
       "math",
       "the same bits everywhere",
       false,
       {}},
      {"-march="
       "native",
       "the same bits everywhere",
       false,
       {"cmake/PalpaOptions.cmake"}},  // says "no ..."
      {"/wo"
       "rk/",
       "a path of one machine",
       false,
       {}},
      {"/tmp/"
       "palpa-",
       "a path of one machine",
       false,
       {}},
      {"NOTE_FROM_"
       "LEAD",
       "a note, not part of the project",
       false,
       {}},
  };
  for (const char* clock : {"steady_"
                            "clock",
                            "system_"
                            "clock",
                            "high_resolution_"
                            "clock",
                            "clock_"
                            "gettime",
                            "gettimeof"
                            "day",
                            "std::ti"
                            "me(",
                            "this_thread::sleep_"
                            "for"})
    all.push_back({clock, time, true, clocks});
  return all;
}

}  // namespace

const std::vector<Forbidden>& forbidden() {
  static const std::vector<Forbidden> all = makeForbidden();
  return all;
}

std::vector<std::string> forbiddenWords(const SourceFile& file) {
  std::vector<std::string> found;
  const std::string code = file.isCode() ? withoutComments(file.text) : "";
  for (const Forbidden& f : forbidden()) {
    if (std::count(f.allowed_in.begin(), f.allowed_in.end(), file.path)) continue;
    if (contains(f.code_only ? code : file.text, f.word))
      found.push_back(file.path + " holds \"" + f.word + "\": " + f.reason);
  }
  return found;
}

}  // namespace palpa::house
