#include "apps/cli/command_tree.h"

#include <algorithm>

namespace palpa::cli {
namespace {

std::vector<std::string> split(const std::string& text, char between) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (std::size_t at = text.find(between); at != std::string::npos;
       at = text.find(between, from = at + 1))
    parts.push_back(text.substr(from, at - from));
  parts.push_back(text.substr(from));
  return parts;
}

std::string joined(const std::vector<std::string>& parts, const std::string& between) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : between) + part;
  return text;
}

/// "a|b|c" of small letters and digits: words to choose from, no names of kinds such as FILE|URL.
bool areWords(const std::string& value) {
  const bool plain = std::all_of(value.begin(), value.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '|';
  });
  return plain && value.find('|') != std::string::npos;
}

/// The library says "TEXT:{f,m}", "FLOAT:[1000 - 4000]", "UINT"; a person is told "f|m", "NUMBER"
/// and the range. What stands behind the colon comes from values.cpp.
void readType(const std::string& type, OptionText* option) {
  const std::size_t colon = type.find(':');
  std::string kind = type.substr(0, colon);
  const std::string limits = colon == std::string::npos ? "" : type.substr(colon + 1);
  if (kind == "FLOAT" || kind == "INT" || kind == "UINT") kind = "NUMBER";
  if (const std::size_t open = limits.find('{'); open != std::string::npos) {
    option->choices = split(limits.substr(open + 1, limits.find('}', open) - open - 1), ',');
    kind = joined(option->choices, "|") + (kind.find("FILE") == std::string::npos ? "" : "|FILE");
  } else if (areWords(kind)) {
    option->choices = split(kind, '|');
  }
  if (const std::size_t open = limits.find('['); open != std::string::npos) {
    const std::string range = limits.substr(open + 1, limits.find(']', open) - open - 1);
    if (const std::size_t dash = range.find(" - "); dash != std::string::npos)
      option->description += " [" + range.substr(0, dash) + " to " + range.substr(dash + 3) + "]";
  }
  option->value = kind;
}

}  // namespace

OptionText describe(const CLI::Option& given) {
  OptionText option;
  for (const std::string& name : given.get_snames()) option.names.push_back("-" + name);
  for (const std::string& name : given.get_lnames()) option.names.push_back("--" + name);
  option.description = given.get_description();
  option.required = given.get_required();
  if (given.get_expected_max() > 0 && given.get_type_size_max() > 0)
    readType(given.get_type_name(), &option);
  if (given.get_positional() && option.names.empty()) {
    const std::string name = given.get_name(true);
    if (option.value.empty() || option.value == "TEXT") option.value = name;
    if (given.get_expected_max() > 1 && option.value.find("...") == std::string::npos)
      option.value += "...";
  }
  return option;
}

namespace {

CommandText described(const CLI::App& app, const std::string& above) {
  CommandText command;
  command.path = above + app.get_name();
  command.description = app.get_description();
  command.footer = app.get_footer();
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    OptionText text = describe(*option);
    (text.names.empty() ? command.positionals : command.options).push_back(std::move(text));
  }
  for (const CLI::App* below :
       app.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); }))
    command.commands.push_back(described(*below, command.path + " "));
  return command;
}

}  // namespace

CommandText describe(const CLI::App& app) { return described(app, ""); }

namespace {

std::string namesOf(const std::set<CLI::Option*>& options) {
  std::string names;
  for (const CLI::Option* option : options) names += " " + option->get_name();
  return names;
}

class PlainHelp : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    const OptionText text = describe(*option);
    std::string words = text.value.empty() ? "" : " " + text.value;
    if (text.required) words += " (required)";
    if (!option->get_needs().empty()) words += " (with" + namesOf(option->get_needs()) + ")";
    if (!option->get_excludes().empty())
      words += " (without" + namesOf(option->get_excludes()) + ")";
    return words;
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    return describe(*option).description;
  }
};

}  // namespace

std::shared_ptr<CLI::FormatterBase> plainHelp() { return std::make_shared<PlainHelp>(); }

}  // namespace palpa::cli
