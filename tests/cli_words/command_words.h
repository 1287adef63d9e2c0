#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/cli/command_tree.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/setting.h"

namespace palpa::cli_words {

using Words = std::vector<std::string>;

/// All commands of the program; their actions are never begun.
class Commands {
 public:
  Commands();

  /// What the program says to these words, without "palpa: "; empty: it takes them.
  std::string complaintAbout(Words words);

  /// Each command: its words ("records", "export") and what its help tells.
  void each(const std::function<void(const Words&, const cli::CommandText&)>& look) const;

 private:
  test::ScratchFolder folder_{"cli-words"};
  test::Setting data_{"XDG_DATA_HOME", folder_.path().string().c_str()},
      records_{"PALPA_RECORDS", nullptr};
  CLI::App program_;
};

/// Empty, or why a person should not be told this.
std::string faultOf(const std::string& complaint);

/// The names that a hand slipped on: each letter another, gone, twice, or swapped with the next.
std::vector<std::string> slipsOf(const std::string& name);

inline bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace palpa::cli_words
