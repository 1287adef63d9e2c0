#include "commands.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <sstream>

#include "shell.h"

namespace palpa::guide {
namespace {

bool isPlaceholder(const std::string& word) {
  return word.find("...") != std::string::npos || word.find('<') != std::string::npos ||
         std::none_of(word.begin(), word.end(),
                      [](char c) { return std::islower(static_cast<unsigned char>(c)); });
}

bool isEnd(const std::string& word) {
  return word == ";" || word == "&&" || word == "|" || word == "&" || word == "||";
}

int wantedCodeOf(const std::string& text) {
  static const std::regex wanted("#.*\\bexits with ([0-9]+)");
  std::smatch found;
  return std::regex_search(text, found, wanted) ? std::stoi(found[1]) : 0;
}

/// roff to text, as far as the page uses it.
std::string withoutFonts(const std::string& roff) {
  return std::regex_replace(std::regex_replace(roff, std::regex("\\\\f[BIR]"), ""),
                            std::regex("\\\\-"), "-");
}

}  // namespace

std::vector<Command> commandsOf(const Block& block) {
  std::vector<Command> all;
  std::istringstream lines(block.text);
  std::string joined;
  int number = block.line - 1, first = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (joined.empty()) first = number;
    joined += line;
    if (joined.ends_with('\\')) {
      joined.back() = ' ';
      continue;
    }
    if (!wordsOf(joined).empty())
      all.push_back({joined, first, wantedCodeOf(joined), block.rest == "slow"});
    joined.clear();
  }
  return all;
}

std::vector<std::string> wordsOf(const std::string& text) {
  std::vector<std::string> words;
  std::string word;
  bool open = false;  // there is a word, if only an empty one
  char quote = 0;
  const auto close = [&] {
    if (open) words.push_back(word);
    word.clear();
    open = false;
  };
  for (const char c : text) {
    if (quote) {
      if (c == quote)
        quote = 0;
      else
        word += c;
    } else if (c == '\'' || c == '"') {
      quote = c;
      open = true;
    } else if (c == '#' && !open) {
      break;
    } else if (c == ';' || c == '|' || c == '&') {
      close();
      if (c == '&' && !words.empty() && words.back() == "&")
        words.back() = "&&";
      else
        words.push_back({c});
    } else if (std::isspace(static_cast<unsigned char>(c))) {
      close();
    } else {
      word += c;
      open = true;
    }
  }
  close();
  return words;
}

Known::Known() : Known(outputOf("'" PALPA_PROGRAM "' manual")) {
  options_["manual"] = {"--completion"};
}  // which no page for readers names

Known::Known(const std::string& manual) {
  std::istringstream lines(manual);
  std::string command;
  static const std::regex option("--[a-z0-9-]+");
  for (std::string line; std::getline(lines, line);) {
    const bool head = line.starts_with("\\fB");
    line = withoutFonts(line);
    if (line.starts_with(".SH")) command.clear();
    if (line.starts_with(".SS palpa "))
      options_[command = line.substr(10)] = {"--help", "--verbose"};
    if (head && line.starts_with("-") && !command.empty())
      for (std::sregex_iterator it(line.begin(), line.end(), option), end; it != end; ++it)
        options_[command].insert(it->str());
  }
}

bool Known::anyHas(const std::string& option) const {
  return std::any_of(options_.begin(), options_.end(),
                     [&](const auto& one) { return one.second.contains(option); });
}

bool Known::begins(const std::string& command) const {
  return std::any_of(options_.begin(), options_.end(), [&](const auto& one) {
    return one.first == command || one.first.starts_with(command + " ");
  });
}

std::string Known::faultOf(const std::string& line) const {
  std::string faults;
  const std::vector<std::string> words = wordsOf(line);
  for (auto at = words.begin(); at != words.end();) {
    const auto end = std::find_if(at, words.end(), isEnd);
    const auto program = std::find_if(at, end, [](const std::string& word) {
      return word == "palpa" || word == "./run" || word.ends_with("/palpa");
    });
    const bool first = std::all_of(at, program, [](const std::string& word) {
      return word.find('=') != std::string::npos || word == "do" || word == "sudo" || word == "man";
    });
    if (program != end && first && !std::count(at, program, "man"))
      faults += faultOfOne({program + 1, end});
    at = end == words.end() ? end : end + 1;
  }
  return faults;
}

std::string Known::faultOfOne(const std::vector<std::string>& words) const {
  std::string command;
  auto at = words.begin();
  for (; at != words.end() && begins(command.empty() ? *at : command + " " + *at); ++at)
    command += (command.empty() ? "" : " ") + *at;
  const bool known = options_.contains(command);
  if (!known && at != words.end() && !at->starts_with("-") && !isPlaceholder(*at))
    return "palpa " + command + " knows no \"" + *at + "\"\n";
  std::string faults;
  for (; at != words.end(); ++at) {
    const std::string option = at->substr(0, at->find('='));
    if (!option.starts_with("--") || option == "--") continue;
    if (known ? !options_.at(command).contains(option)
              : option != "--help" && option != "--version" && option != "--yes")
      faults += "palpa " + command + " knows no option " + option + "\n";
  }
  return faults;
}

}  // namespace palpa::guide
