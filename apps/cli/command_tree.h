#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace palpa::cli {

/// An option as people and shells are told of it.
struct OptionText {
  std::vector<std::string> names;    ///< "-h", "--help"; empty for what stands without a name
  std::string value;                 ///< "FILE", "NUMBER", "on|off"; empty for a flag
  std::vector<std::string> choices;  ///< the words that may be given, where there are only these
  std::string description;           ///< with the range of a number
  bool required = false;
};

/// A command with everything below it, as its --help tells it. What is hidden there is left out
/// here.
struct CommandText {
  std::string path;                 ///< "palpa records export"
  std::string description, footer;  ///< footer: the examples
  std::vector<OptionText> options, positionals;
  std::vector<CommandText> commands;
};

CommandText describe(const CLI::App& app);

}  // namespace palpa::cli
