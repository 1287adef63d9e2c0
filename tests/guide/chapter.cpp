#include "chapter.h"

#include <cstdlib>
#include <fstream>

#include "tree.h"

namespace palpa::guide {
namespace {

namespace fs = std::filesystem;

std::string quoted(const std::string& text) {
  std::string all = "'";
  for (const char c : text) all += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return all + "'";
}

std::string told(const Command& c) {
  return "command_of " + std::to_string(c.line) + " " + std::to_string(c.exit_code) + " " +
         quoted(c.text) + "\n";
}

}  // namespace

bool everything() {
  const char* full = std::getenv("PALPA_FULL");
  return full && std::string(full) == "1";
}

std::vector<Command> commandsOf(const Page& page) {
  std::vector<Command> all;
  for (const Block& block : page.blocks)
    if (block.language == "sh")
      for (Command& command : commandsOf(block)) all.push_back(std::move(command));
  return all;
}

std::string scriptOf(const Page& page, const fs::path& work) {
  std::string script;
  for (const auto& [name, value] : {std::pair{"work", work},
                                    {"source", top()},
                                    {"build", fs::path(PALPA_BUILD_DIR)},
                                    {"program", fs::path(PALPA_PROGRAM)}})
    script += std::string(name) + "=" + quoted(value.string()) + "\n";
  script += ". " + quoted((top() / "tests/guide/chapter.sh").string()) + "\n";
  for (const Block& block : page.blocks) {
    if (block.language != "sh") {
      if (!block.rest.empty())
        script += "printf %s " + quoted(block.text) + " >" + quoted(block.rest) + "\n";
      continue;
    }
    if (block.rest == "slow" && !everything()) continue;
    for (const Command& command : commandsOf(block)) script += told(command);
  }
  return script + "close_console\n";
}

std::set<int> skippedIn(const Page& page, const fs::path& work) {
  std::set<int> lines;
  std::ifstream stream(work / "skipped");
  for (int line; stream >> line;) lines.insert(line);
  for (const Command& command : commandsOf(page))
    if (command.slow && !everything()) lines.insert(command.line);
  return lines;
}

}  // namespace palpa::guide
