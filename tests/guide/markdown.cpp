#include "markdown.h"

#include <cctype>
#include <fstream>
#include <regex>
#include <stdexcept>

namespace palpa::guide {
namespace {

/// Small letters and digits; spaces become hyphens, other signs go. Letters outside ASCII stay.
std::string anchorOf(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isalnum(u) || c == '-' || c == '_' || u >= 0x80)
      anchor += static_cast<char>(std::tolower(u));
    else if (c == ' ')
      anchor += '-';
  }
  return anchor;
}

void addMatches(const std::string& line, int number, Page& page) {
  static const std::regex code("`([^`]+)`"), link(R"((!?)\[[^\]]*\]\(([^)\s]+)\))");
  for (std::sregex_iterator it(line.begin(), line.end(), code), end; it != end; ++it)
    page.code.push_back({(*it)[1], number});
  const std::string words = std::regex_replace(line, code, "");
  for (std::sregex_iterator it(words.begin(), words.end(), link), end; it != end; ++it)
    page.links.push_back({(*it)[2], (*it)[1] == "!", number});
}

Block opened(const std::string& fence, int line) {
  const std::size_t space = fence.find(' ');
  Block block;
  block.language = fence.substr(3, space == std::string::npos ? space : space - 3);
  if (space != std::string::npos) block.rest = fence.substr(space + 1);
  block.line = line + 1;
  return block;
}

}  // namespace

Page readPage(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(file.string() + " cannot be read");
  Page page;
  page.file = file;
  bool inside = false;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (line.starts_with("```")) {
      if (!inside) page.blocks.push_back(opened(line, number));
      inside = !inside;
    } else if (inside) {
      page.blocks.back().text += line + "\n";
    } else {
      if (line.starts_with("#"))
        page.anchors.push_back(anchorOf(line.substr(line.find_first_not_of("# "))));
      addMatches(line, number, page);
    }
  }
  if (inside)
    throw std::runtime_error(file.string() + ": a block that begins in line " +
                             std::to_string(page.blocks.back().line) + " has no end");
  return page;
}

}  // namespace palpa::guide
