#pragma once

#include <cstdlib>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

/// A report read as its reader reads it.
namespace palpa::test {

/// Each element's words are a line of their own; drawings are left out.
inline std::vector<std::string> linesOf(std::string html) {
  // The last one first, for one may lie within another.
  for (std::size_t from; (from = html.rfind("<svg")) != std::string::npos;)
    html.erase(from, html.find("</svg>", from) + 6 - from);
  std::string text = std::regex_replace(html, std::regex("<[^>]*>"), "\n");
  for (const auto& [entity, sign] :
       {std::pair{"&#39;", "'"}, {"&quot;", "\""}, {"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}})
    text = std::regex_replace(text, std::regex(entity), sign);
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (const auto at = line.find_first_not_of(' '); at != std::string::npos)
      lines.push_back(line.substr(at));
  return lines;
}

/// "2.5 mm", "−3", "1 234.5": the number that it begins with.
inline double numberIn(std::string text) {
  for (const auto& [sign, plain] : {std::pair{"\u2212", "-"}, {"\u202f", ""}})
    text = std::regex_replace(text, std::regex(sign), plain);
  return std::strtod(text.c_str(), nullptr);
}

/// The first of `lines` that the pattern finds something in, and what; none: an empty one.
inline std::vector<std::string> found(const std::vector<std::string>& lines,
                                      const std::string& pattern) {
  const std::regex wanted(pattern);
  std::smatch match;
  for (const std::string& line : lines)
    if (std::regex_search(line, match, wanted)) return {match.begin(), match.end()};
  return {};
}

}  // namespace palpa::test
