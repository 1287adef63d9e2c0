#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "markdown.h"

namespace palpa::guide {

/// A line of a shell as one command; `\` at the end of a line joins the next one to it.
struct Command {
  std::string text;
  int line = 0;
  int exit_code = 0;  ///< wanted: what a comment "# exits with 1" says, otherwise 0
  bool slow = false;  ///< of a block "sh slow"
};

/// Of one block; empty lines and comments do not count.
std::vector<Command> commandsOf(const Block& block);

/// Words as a shell would part them: quotes are taken off, a comment is left out; ";", "&&", "|"
/// and "&" are words.
std::vector<std::string> wordsOf(const std::string& text);

/// What the program knows: every command and its options, as `palpa manual` makes them of --help
/// (tests/package holds the two to be the same).
class Known {
 public:
  /// Asks the built program.
  Known();
  explicit Known(const std::string& manual);

  /// What is wrong with every `palpa ...` in a line, in words; empty: nothing. Words in capitals,
  /// "..." and <words> stand for something.
  std::string faultOf(const std::string& line) const;
  bool anyHas(const std::string& option) const;
  std::size_t commands() const { return options_.size(); }

 private:
  std::string faultOfOne(const std::vector<std::string>& words) const;
  bool begins(const std::string& command) const;

  std::map<std::string, std::set<std::string>> options_;  ///< "calibrate camera" -> --images, ...
};

}  // namespace palpa::guide
