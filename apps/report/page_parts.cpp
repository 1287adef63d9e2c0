#include "apps/report/page_parts.h"

#include <algorithm>
#include <cctype>

#include "apps/report/style.h"

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
  const auto item = [&](const char* name, const std::string& value) {
    if (value.empty()) return;
    const auto span = html.in("span");
    html.text(std::string(name) + ' ');
    html.element("strong", value);
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

}  // namespace palpa::report
