#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace palpa::report::test {

/// "" when every tag of the page is closed in order, every attribute quoted, every & an entity;
/// else the first fault with its surroundings. Knows what this project's pages use of HTML.
inline std::string faultOf(std::string_view page) {
  static const std::set<std::string> kEmpty{"meta", "img", "br", "!doctype"};
  std::vector<std::string> open;
  const auto around = [&](std::size_t i) { return std::string(page.substr(i, 60)); };
  for (std::size_t i = 0; i < page.size(); ++i) {
    if (page[i] == '&') {
      const std::size_t end = page.find(';', i);
      if (end == std::string_view::npos || end - i > 8) return "bare & at " + around(i);
    }
    if (page[i] == '>') return "bare > at " + around(i);
    if (page[i] != '<') continue;
    std::size_t end = i + 1;
    bool quoted = false;
    for (; end < page.size() && (quoted || page[end] != '>'); ++end) {
      if (page[end] == '"') quoted = !quoted;
      if (page[end] == '<') return "< within a tag at " + around(i);
    }
    if (end == page.size()) return "tag without end at " + around(i);
    const std::string_view tag = page.substr(i + 1, end - i - 1);
    const bool closes = tag.starts_with('/');
    const std::size_t start = closes ? 1 : 0;
    const std::string name(tag.substr(start, tag.find_first_of(" /", start) - start));
    if (closes) {
      if (open.empty() || open.back() != name)
        return "</" + name + "> closes nothing: " + around(i);
      open.pop_back();
    } else if (!tag.ends_with('/') && !kEmpty.contains(name)) {
      open.push_back(name);
    }
    i = end;
    if (!closes && name == "style") i = page.find("</style", end) - 1;
  }
  return open.empty() ? "" : "<" + open.back() + "> is never closed";
}

}  // namespace palpa::report::test
