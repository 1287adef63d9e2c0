#include "apps/language/markup.h"

#include <algorithm>

#include "apps/language/phrase.h"

namespace palpa::language {
namespace {

constexpr std::string_view kRead[] = {" title=\"", " alt=\"", " aria-label=\"", " placeholder=\""};
struct Entity {
  std::string_view written, means;
};
constexpr Entity kEntities[] = {{"&amp;", "&"},   {"&lt;", "<"},  {"&gt;", ">"},
                                {"&quot;", "\""}, {"&#39;", "'"}, {"&nbsp;", "\u00a0"}};

std::string unescaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto* found = std::find_if(std::begin(kEntities), std::end(kEntities),
                                     [&](const Entity& e) { return text.starts_with(e.written); });
    out += found == std::end(kEntities) ? text.substr(0, 1) : found->means;
    text.remove_prefix(found == std::end(kEntities) ? 1 : found->written.size());
  }
  return out;
}

std::string escapedAgain(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto* found =
        std::find_if(std::begin(kEntities), std::end(kEntities),
                     [c](const Entity& e) { return e.means == std::string_view(&c, 1); });
    out += found == std::end(kEntities) ? std::string_view(&c, 1) : found->written;
  }
  return out;
}

/// "<td class=...>" -> "td", "</td>" -> "/td"
std::string_view nameOf(std::string_view tag) {
  const std::size_t end = tag.find_first_of(" \n\t/>", 2);
  return tag.substr(1, (end == std::string_view::npos ? tag.size() : end) - 1);
}

std::string_view upTo(std::string_view* rest, std::string_view words, bool with) {
  const std::size_t at = rest->find(words);
  const std::size_t size =
      at == std::string_view::npos ? rest->size() : at + (with ? words.size() : 0);
  const std::string_view piece = rest->substr(0, size);
  rest->remove_prefix(size);
  return piece;
}

bool saysSomething(std::string_view text) {
  return std::any_of(text.begin(), text.end(), isLetterOrDigit);
}

bool hasNoEnd(std::string_view name) {
  static constexpr std::string_view kNames[] = {"meta", "br", "hr", "img", "link", "input", "col"};
  return name.starts_with('!') ||
         std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

}  // namespace

std::string PageSpeaker::more(std::string_view page) {
  if (spoken_.book.isEnglish()) return std::string(page);
  std::string out;
  while (!page.empty()) {
    const std::string_view text = upTo(&page, "<", false);
    out += kept_ ? std::string(text) : said(text);
    if (page.starts_with("<!--")) {
      out += upTo(&page, "-->", true);
    } else if (!page.empty()) {
      const std::string_view written = upTo(&page, ">", true);
      const std::string_view name = nameOf(written);
      out += tag(written);
      if (name == "style") out += upTo(&page, "</style>", true);
      if (name == "script") out += upTo(&page, "</script>", true);
    }
  }
  return out;
}

std::string PageSpeaker::said(std::string_view written) {
  if (!saysSomething(written)) return std::string(written);
  if (const auto known = said_.find(written); known != said_.end()) return known->second;
  std::string now = escapedAgain(spoken_.book.said(unescaped(written)));
  return said_.emplace(written, std::move(now)).first->second;
}

std::string PageSpeaker::tag(std::string_view written) {
  const std::string_view name = nameOf(written);
  if (name == "html")
    return "<html lang=\"" + spoken_.code + "\"" + (spoken_.from_right ? " dir=\"rtl\">" : ">");
  std::string out = kept_ ? std::string(written) : withAttributes(written);
  if (name != "style" && name != "script") count(name, written);
  return out;
}

void PageSpeaker::count(std::string_view name, std::string_view written) {
  if (written.ends_with("/>") || hasNoEnd(name)) return;
  if (kept_)
    kept_ += name.starts_with('/') ? -1 : 1;
  else if (written.find(" translate=\"no\"") != std::string_view::npos)
    kept_ = 1;
}

std::string PageSpeaker::withAttributes(std::string_view written) {
  std::string tag(written);
  for (const std::string_view name : kRead) {
    const std::size_t at = tag.find(name);
    if (at == std::string::npos) continue;
    const std::size_t from = at + name.size(), end = tag.find('"', from);
    if (end == std::string::npos) continue;
    tag.replace(from, end - from, said(std::string_view(tag).substr(from, end - from)));
  }
  return tag;
}

std::string pageIn(std::string_view page, const Spoken& spoken) {
  return PageSpeaker(spoken).more(page);
}

}  // namespace palpa::language
