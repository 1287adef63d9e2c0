#pragma once

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

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
OptionText describe(const CLI::Option& option);

/// How --help tells options: as above, in place of the library's names of types.
std::shared_ptr<CLI::FormatterBase> plainHelp();

/// The program's manual page, palpa(1), in roff: every command with its options and examples.
/// `welcome`: what the program says when it is started alone.
std::string manualPage(const CommandText& program, const std::string& version,
                       const std::string& welcome);

/// A completion of bash: commands, options, words that may be chosen, files and folders where an
/// option takes them.
std::string bashCompletion(const CommandText& program);

}  // namespace palpa::cli
