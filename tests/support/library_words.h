#pragma once

#include <fstream>
#include <string>
#include <vector>

namespace palpa::test {

/// Phrases by which a library's own words are known: library_words.txt, which scripts read as well.
inline const std::vector<std::string>& libraryWords() {
  static const std::vector<std::string> words = [] {
    std::vector<std::string> all;
    std::ifstream file(PALPA_SOURCE_DIR "/tests/support/library_words.txt");
    for (std::string line; std::getline(file, line);)
      if (!line.empty()) all.push_back(line);
    return all;
  }();
  return words;
}

/// The first of them in this text; empty: none.
inline std::string libraryWordsIn(const std::string& text) {
  if (libraryWords().empty()) return "the list of libraries' words is not there";
  for (const std::string& word : libraryWords())
    if (text.find(word) != std::string::npos) return word;
  return "";
}

}  // namespace palpa::test
