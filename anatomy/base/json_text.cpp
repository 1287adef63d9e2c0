#include "anatomy/base/json_text.h"

#include <algorithm>

namespace palpa {

using nlohmann::json;

namespace {

/// What the parser calls a mistake, and what it is called here; the first that fits counts.
struct Mistake {
  const char *parsers, *ours;
};
constexpr Mistake kMistakes[] = {
    {"unexpected end of input", "the text ends before everything that was opened is closed"},
    {"missing closing quote", "the text ends within quotation marks"},
    {"ill-formed UTF-8", "a letter is damaged (the text must be UTF-8)"},
    {"BOM", "a letter is damaged (the text must be UTF-8)"},
    {"control character", "a line break or another control character stands in quotation marks"},
    {"backslash", "a backslash is followed by something that it cannot stand before"},
    {"'\\u'", "after \\u come four digits or letters a to f"},
    {"surrogate", "a letter written with \\u is only half there"},
    {"comment", "comments are not allowed: write a field \"about\""},
    {"invalid number", "a number is not complete"},
    {"parsing object key",
     "here must be a field's name in quotation marks (is there a comma too many?)"},
    {"invalid literal",
     "here must be a number, a text in quotation marks, a list, an object, true, false or null"},
    {"; expected end of input", "more follows after the end"},
    {"; expected '}'", "a comma or } is missing before this"},
    {"; expected ']'", "a comma or ] is missing before this"},
    {"; expected ':'", "a colon is missing before this"},
    {"parsing value", "a value is missing before this (or there is a comma too many)"},
};

std::string inOurWords(std::string_view parsers) {
  for (const Mistake& mistake : kMistakes)
    if (parsers.find(mistake.parsers) != std::string_view::npos) return mistake.ours;
  return "something is not as it must be";
}

/// "line 3, column 5"; columns are letters, not bytes.
std::string placeIn(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at);
  const std::size_t line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::string_view here = before.substr(before.rfind('\n') + 1);
  const auto inside = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
  const std::size_t column = here.size() - std::count_if(here.begin(), here.end(), inside) + 1;
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

/// The number that is too large for the program, between the parser's quotation marks.
std::string largeNumberIn(std::string_view parsers) {
  const std::size_t from = parsers.find('\'');
  if (from == std::string_view::npos) return "";
  return std::string(parsers.substr(from + 1, parsers.find('\'', from + 1) - from - 1));
}

}  // namespace

std::string whyNoJson(std::string_view text, const json::exception& refused) {
  constexpr std::size_t kLongestNumber = 40;
  const std::string_view parsers = refused.what();
  if (const auto* syntax = dynamic_cast<const json::parse_error*>(&refused))
    return placeIn(text, syntax->byte ? syntax->byte - 1 : 0) + ": " + inOurWords(parsers);
  if (parsers.find("number overflow") == std::string_view::npos)
    return "a field is missing, or holds something else than it must";
  const std::string number = largeNumberIn(parsers);
  return placeIn(text, std::min(text.find(number), text.size())) + ": the number " +
         number.substr(0, kLongestNumber) + " is too large";
}

json parseJson(std::string_view text) { return json::parse(text); }

json parseJson(std::string_view text, int deepest, const std::function<void()>& too_deep) {
  return json::parse(text, [&](int depth, json::parse_event_t, json&) {
    if (depth > deepest) too_deep();
    return true;
  });
}

json parsedOrDiscarded(std::string_view text) { return json::parse(text, nullptr, false); }

}  // namespace palpa
