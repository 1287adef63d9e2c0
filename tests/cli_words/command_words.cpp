#include "command_words.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <stdexcept>

#include "apps/cli/commands.h"
#include "apps/cli/usage_words.h"
#include "tests/support/library_words.h"

namespace palpa::cli_words {
namespace {

void visit(const cli::CommandText& command,
           const std::function<void(const Words&, const cli::CommandText&)>& look) {
  std::istringstream path(command.path);
  Words words;
  for (std::string word; path >> word;) words.push_back(word);
  words.erase(words.begin());  // the program's own
  look(words, command);
  for (const cli::CommandText& below : command.commands) visit(below, look);
}

}  // namespace

Commands::Commands() {
  cli::addCommands(program_);
  // Called when all words were taken, before any action; as the program asks then.
  program_.parse_complete_callback([this] {
    cli::refuseLackingValues(program_);
    throw CLI::Success();
  });
}

std::string Commands::complaintAbout(Words words) {
  std::reverse(words.begin(), words.end());
  try {
    program_.parse(std::move(words));
  } catch (const CLI::ParseError& e) {
    return e.get_exit_code() == 0 ? "" : cli::usageWords(e, program_);
  }
  throw std::logic_error("an action was begun");
}

void Commands::each(const std::function<void(const Words&, const cli::CommandText&)>& look) const {
  visit(cli::describe(program_), look);
}

std::string faultOf(const std::string& complaint) {
  if (const std::string word = test::libraryWordsIn(complaint); !word.empty())
    return "a library's words: " + word;
  // The command line's library has more, which may stand in other messages of ours.
  for (const char* foreign :
       {"in range", "Error", "OpenCV", "is required", "requires", "excludes", "subcommand", "INT",
        "FLOAT", "{", "}", " OR ", "arguments to", "At Most", "At least"})
    if (holds(complaint, foreign)) return std::string("a library's words: ") + foreign;
  if (holds(complaint, "\n")) return "more than a line";
  if (!holds(complaint, " See: palpa")) return "no way to the help";
  return holds(complaint, ".. See") || holds(complaint, "?.") ? "two ends of a sentence" : "";
}

std::vector<std::string> slipsOf(const std::string& name) {
  std::vector<std::string> slips;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (!std::isalpha(static_cast<unsigned char>(name[i]))) continue;
    std::string other = name, gone = name, twice = name, swapped = name;
    other[i] = name[i] == 'x' ? 'y' : 'x';
    gone.erase(i, 1);
    twice.insert(i, 1, name[i]);
    slips.insert(slips.end(), {other, gone, twice});
    if (i + 1 < name.size() && name[i + 1] != name[i]) {
      std::swap(swapped[i], swapped[i + 1]);
      slips.push_back(swapped);
    }
  }
  return slips;
}

}  // namespace palpa::cli_words
