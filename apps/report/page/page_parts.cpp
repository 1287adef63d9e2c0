#include "apps/report/page/page_parts.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string>

#include "apps/report/page/style.h"

namespace palpa::report {
namespace {

std::string softwareAmong(std::initializer_list<const std::vector<Fact>*> groups) {
  for (const auto* facts : groups) {
    for (const Fact& fact : *facts) {
      std::string name = fact.name;
      std::transform(name.begin(), name.end(), name.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      if (name == "software" || name == "software version") return fact.value;
    }
  }
  return "";
}

}  // namespace

void writeHeadElement(Html& html, const std::string& title, const std::string& trainee,
                      std::string_view more_style) {
  const auto head = html.in("head");
  html.empty("meta", {{"charset", "utf-8"}});
  html.empty("meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}});
  html.empty("meta", {{"name", "color-scheme"}, {"content", "light dark"}});
  html.element("title", title + (trainee.empty() ? "" : " · " + trainee));
  const auto style = html.in("style");
  html.raw(styleSheet());
  html.raw(more_style);
}

void writeWho(Html& html, const std::string& trainee, const std::string& when, std::size_t trials) {
  const auto who = html.in("p", {{"class", "who"}});
  // A pseudonym has no blanks; words for a simulated operator have.
  const auto item = [&](const char* name, const std::string& value) {
    if (value.empty()) return;
    const auto span = html.in("span");
    html.text(std::string(name) + ' ');
    html.element("strong", {{"translate", value.find(' ') == std::string::npos ? "no" : ""}},
                 value);
  };
  item("Trainee", trainee);
  item("Date", when);
  item("Trials", std::to_string(trials));
}

void writeSimulatedBanner(Html& html) {
  const auto banner = html.in("p", {{"class", "banner"}, {"role", "note"}});
  html.element("strong", "SIMULATED");
  html.text("The operator or the bench is simulated. These results say nothing about a person.");
}

void writeFactTable(Html& html, const std::vector<Fact>& facts) {
  if (facts.empty()) return;
  const auto table = html.in("table", {{"class", "facts"}});
  const auto body = html.in("tbody");
  for (const Fact& fact : facts) {
    const auto row = html.in("tr");
    html.element("th", {{"scope", "row"}}, fact.name);
    html.element("td", {{"class", "value"}}, fact.value);
    html.element("td", {{"class", "muted"}}, fact.remark);
  }
}

void writeFacts(Html& html, const char* title, const std::vector<Fact>& facts) {
  if (facts.empty()) return;
  const auto section = html.in("section", {{"class", "card"}});
  html.element("h2", title);
  writeFactTable(html, facts);
}

void writeMadeBy(Html& html, std::initializer_list<const std::vector<Fact>*> groups) {
  const std::string software = softwareAmong(groups);
  if (!software.empty()) html.element("p", {{"class", "muted small"}}, "Made by " + software + ".");
}

namespace {

void writeRows(Html& html, const DataTable& data) {
  const auto scroll = html.in("div", {{"class", "scroll"}, {"tabindex", "0"}});
  const auto table = html.in("table", {{"class", "data"}});
  {
    const auto head = html.in("thead"), row = html.in("tr");
    for (std::size_t i = 0; i < data.columns.size(); ++i)
      html.element("th", {{"scope", "col"}, {"class", i >= data.words_from ? "words" : ""}},
                   data.columns[i]);
  }
  const auto body = html.in("tbody");
  for (const std::vector<std::string>& cells : data.rows) {
    const auto row = html.in("tr");
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (i == 0)
        html.element("th", {{"scope", "row"}}, cells[i]);
      else
        html.element("td", {{"class", i >= data.words_from ? "words" : ""}}, cells[i]);
    }
  }
}

}  // namespace

void writeDataTable(Html& html, const DataTable& table) {
  if (table.rows.empty()) return;
  const auto details = html.in("details", {{"class", "behind"}});
  html.element("summary", table.title);
  writeRows(html, table);
}

void writeOpenTable(Html& html, const DataTable& table) {
  if (!table.rows.empty()) writeRows(html, table);
}

namespace {

std::string plain(double value, int decimals) {
  char text[400];  // the largest double has 309 digits before the point
  const auto end =
      std::to_chars(text, text + sizeof(text), value, std::chars_format::fixed, decimals);
  std::string digits(text, end.ptr);
  const bool zero = digits.find_first_of("123456789") == std::string::npos;
  return zero && digits[0] == '-' ? digits.substr(1) : digits;
}

void dropTrailingZeros(std::string& digits) {
  if (digits.find('.') == std::string::npos) return;
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
}

/// Minus sign U+2212, and U+202F between thousands from 10 000 on.
std::string dressed(const std::string& digits) {
  const bool negative = digits[0] == '-';
  const std::size_t start = negative ? 1 : 0;
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::size_t whole = point - start;
  std::string text = negative ? "\u2212" : "";
  for (std::size_t i = start; i < digits.size(); ++i) {
    if (whole > 4 && i > start && i < point && (point - i) % 3 == 0) text += "\u202f";
    text += digits[i];
  }
  return text;
}

}  // namespace

std::string shortest(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof(text), value).ptr};
}

std::string fixed(double value, int decimals) {
  return std::isfinite(value) ? dressed(plain(value, decimals)) : "–";
}

std::string trimmed(double value, int decimals) {
  if (!std::isfinite(value)) return "–";
  std::string digits = plain(value, decimals);
  dropTrailingZeros(digits);
  return dressed(digits);
}

std::string coordinate(double value) {
  std::string digits = plain(std::isfinite(value) ? value : 0, 1);
  dropTrailingZeros(digits);
  return digits;
}

}  // namespace palpa::report
