#include <cstdio>
#include <map>

#include "apps/cli/command_tree.h"
#include "apps/cli/commands.h"

namespace palpa::cli {
namespace {

struct Named {
  const char* name;
  const char* words;
};

constexpr Named kFiles[] = {
    {"out/<command>-<time>/",
     "what a session leaves, unless --out names another folder: report.html, trials.csv, "
     "session.palpa (the evidence), pictures"},
    {"~/.local/share/palpa/records.sqlite",
     "the usual records of trainees; nobody is recorded unless records and a trainee are named"},
    {"~/.local/share/palpa/console/", "what the console keeps of the sessions that it started"},
    {"~/.local/state/palpa/pending/", "sessions that wait to be delivered to the records"},
    {"~/.cache/palpa/patients/",
     "patients that were built, so that the next session starts sooner: at most 512 MB, the oldest "
     "go first. No imported patient. It may be removed at any time"},
    {"/usr/share/palpa/assets/",
     "materials, patients, tasks, stations, protocols: data with units and sources. Copy a "
     "station's file from stations/ and change the copy"},
};

constexpr Named kVariables[] = {
    {"PALPA_ASSETS", "another folder with the program's data"},
    {"PALPA_CACHE",
     "in place of ~/.cache/palpa, the folder where patients that were built are kept; off: none is "
     "kept"},
    {"PALPA_RECORDS",
     "the records of trainees: a file, or postgresql://user@host/database (the password in "
     "~/.pgpass)"},
    {"DISPLAY",
     "without it nothing is shown in a window: a simulated operator performs, pictures are drawn "
     "into files"},
    {"XR_RUNTIME_JSON", "the headset's OpenXR runtime, where it is not the usual one"},
    {"XDG_DATA_HOME, XDG_STATE_HOME, XDG_CACHE_HOME, XDG_CONFIG_HOME",
     "in place of ~/.local/share, ~/.local/state, ~/.cache and ~/.config"},
    {"XDG_RUNTIME_DIR", "where a running session and the console meet"},
    {"NETRC", "where the password of a learning record store is, in place of ~/.netrc"},
};

constexpr Named kCodes[] = {{"0", "done; a trial without success is done as well"},
                            {"1", "the work failed"},
                            {"2", "wrong usage, or a wrong settings file"}};

/// Plain text for roff: no dash becomes a hyphen, no leading dot a request.
std::string plain(const std::string& text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = i == 0 || text[i - 1] == '\n';
    if (begins && (text[i] == '.' || text[i] == '\'')) escaped += "\\&";
    if (text[i] == '\\')
      escaped += "\\e";
    else if (text[i] == '-')
      escaped += "\\-";
    else
      escaped += text[i];
  }
  return escaped;
}

std::string sentence(const std::string& text) {
  return text.empty() || text.find_last_of(".?!") == text.size() - 1 ? text : text + ".";
}

std::string bold(const std::string& text) { return "\\fB" + plain(text) + "\\fR"; }
std::string slanted(const std::string& text) { return "\\fI" + plain(text) + "\\fR"; }

std::string listOf(const Named* from, const Named* to) {
  std::string page;
  for (; from != to; ++from) page += ".TP\n" + bold(from->name) + "\n" + plain(from->words) + ".\n";
  return page;
}

/// Lines as they stand.
std::string asItStands(const std::string& text) {
  return ".PP\n.nf\n" + plain(text) + (text.empty() || text.back() != '\n' ? "\n" : "") + ".fi\n";
}

std::string itemOf(const OptionText& option) {
  std::string head;
  for (const std::string& name : option.names) head += (head.empty() ? "" : ", ") + bold(name);
  if (!option.value.empty()) head += (head.empty() ? "" : " ") + slanted(option.value);
  return ".TP\n" + head + "\n" +
         plain(option.description + (option.required ? " (required)" : "")) + "\n";
}

std::string synopsisOf(const CommandText& command) {
  std::string line = bold(command.path);
  for (const OptionText& option : command.options)
    if (option.required) line += " " + bold(option.names.back()) + " " + slanted(option.value);
  if (command.options.size() > 1) line += " [" + slanted("options") + "]";
  for (const OptionText& one : command.positionals)
    line += one.required ? " " + slanted(one.value) : " [" + slanted(one.value) + "]";
  return line;
}

std::string sectionsOf(const CommandText& command) {
  std::string page;
  for (const CommandText& below : command.commands) page += sectionsOf(below);
  if (!command.commands.empty() && command.positionals.empty() && command.options.size() < 2)
    return page;  // a group: its commands stand for themselves
  std::string section = ".SS " + plain(command.path) + "\n" + plain(sentence(command.description)) +
                        "\n.PP\n" + synopsisOf(command) + "\n";
  for (const OptionText& one : command.positionals) section += itemOf(one);
  for (const OptionText& option : command.options)
    if (option.names.back() != "--help") section += itemOf(option);
  if (!command.footer.empty()) section += asItStands(command.footer);
  return section + page;
}

}  // namespace

std::string manualPage(const CommandText& program, const std::string& version,
                       const std::string& welcome) {
  std::string page = ".\\\" Made by the program itself from its own --help: palpa manual\n";
  page += ".TH PALPA 1 \"\" \"" + plain(version) + "\" \"User Commands\"\n.SH NAME\npalpa \\- " +
          plain(program.description) + "\n";
  page += ".SH SYNOPSIS\n" + bold("palpa") + " " + slanted("command") + " [" + slanted("options") +
          "]\n.PP\n" + bold("palpa --version") + "\n.PP\n" + bold("palpa") + " [" +
          slanted("command") + "] " + bold("--help") + "\n";
  page += ".SH DESCRIPTION\n" + asItStands(welcome) +
          ".PP\nNot a medical device: Palpa has not been validated on people.\n.SH COMMANDS\nEvery "
          "command also understands " +
          bold("--help") + " and " + bold("--verbose") + ".\n";
  for (const CommandText& command : program.commands) page += sectionsOf(command);
  page += ".SH EXIT STATUS\n" + listOf(std::begin(kCodes), std::end(kCodes));
  page += ".SH ENVIRONMENT\n" + listOf(std::begin(kVariables), std::end(kVariables));
  page += ".SH FILES\n" + listOf(std::begin(kFiles), std::end(kFiles));
  return page;
}

namespace {

bool holds(const std::string& text, const char* word) {
  return text.find(word) != std::string::npos;
}

/// What the shell offers for a value: "file", "dir", "words a b", or "other" (nothing).
std::string kindOf(const OptionText& option) {
  if (!option.choices.empty()) {
    std::string words = "words";
    for (const std::string& choice : option.choices) words += " " + choice;
    return words;
  }
  if (holds(option.value, "FILE") || holds(option.value, "GLOB") || option.value == "SESSION")
    return "file";
  if (holds(option.value, "DIR") || holds(option.value, "FOLDER")) return "dir";
  return "other";
}

/// What is collected over the whole tree.
struct Tables {
  std::string paths;                          ///< "palpa records"|"palpa records export"
  std::map<std::string, std::string> values;  ///< kind: patterns of "command --option"
  std::string words;                          ///< of each command: a line of a case
};

void collect(const CommandText& command, Tables* t) {
  std::string next, positional;
  for (const CommandText& below : command.commands) {
    next += (next.empty() ? "" : " ") + below.path.substr(below.path.rfind(' ') + 1);
    t->paths += (t->paths.empty() ? "\"" : "|\"") + below.path + "\"";
  }
  std::string options;
  for (const OptionText& option : command.options)
    for (const std::string& name : option.names) {
      options += (options.empty() ? "" : " ") + name;
      if (option.value.empty()) continue;
      std::string& patterns = t->values[kindOf(option)];
      patterns += (patterns.empty() ? "\"" : "|\"") + command.path + " " + name + "\"";
    }
  for (const OptionText& one : command.positionals)
    if (positional.empty()) positional = kindOf(one);
  t->words += "    \"" + command.path + "\") next=\"" + next + "\" options=\"" + options +
              "\" plain=\"" + positional + "\" ;;\n";
  for (const CommandText& below : command.commands) collect(below, t);
}

constexpr const char* kOffer = R"(
_palpa_offer() {   # KIND: what a value may be
  local word=${COMP_WORDS[COMP_CWORD]}
  [ "$word" = = ] && word=
  case "$1" in
    file) compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -f -- "$word") ;;
    dir) compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -d -- "$word") ;;
    words*) mapfile -t COMPREPLY < <(compgen -W "${1#words }" -- "$word") ;;
  esac
}

_palpa() {
  local at=palpa kind next options plain i word=${COMP_WORDS[COMP_CWORD]} before
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; i++)); do
    _palpa_value "$at" "${COMP_WORDS[i]}"
    if [ -n "$kind" ]; then
      [ "${COMP_WORDS[i + 1]}" = = ] && ((++i))
      ((++i))
    elif _palpa_known "$at ${COMP_WORDS[i]}"; then
      at="$at ${COMP_WORDS[i]}"
    fi
  done
  before=${COMP_WORDS[COMP_CWORD - 1]}
  [ "$before" = = ] && before=${COMP_WORDS[COMP_CWORD - 2]}
  _palpa_value "$at" "$before"
  if [ -n "$kind" ]; then _palpa_offer "$kind"; return; fi
  _palpa_words "$at"
  case "$word" in
    -*) mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word") ;;
    *) if [ -n "$next" ]; then _palpa_offer "words $next"
       elif [ -n "$plain" ]; then _palpa_offer "$plain"
       else mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word"); fi ;;
  esac
}

complete -F _palpa palpa
)";

}  // namespace

std::string bashCompletion(const CommandText& program) {
  Tables tables;
  collect(program, &tables);
  std::string script =
      "# bash completion of palpa, made by the program itself: palpa manual "
      "--completion\n\n_palpa_known() {   # is this a command?\n  case \"$1\" in\n    " +
      tables.paths + ") return 0 ;;\n  esac\n  return 1\n}\n";
  script +=
      "\n_palpa_value() {   # COMMAND OPTION: sets kind to what the option's value may be, empty "
      "where it has none\n  kind=\n  case \"$1 $2\" in\n";
  for (const auto& [kind, patterns] : tables.values)
    script += "    " + patterns + ") kind=\"" + kind + "\" ;;\n";
  script +=
      "  esac\n}\n\n_palpa_words() {   # COMMAND: sets next, options, plain\n  next= options= "
      "plain=\n  case \"$1\" in\n" +
      tables.words + "  esac\n}\n";
  return script + kOffer;
}

void addManual(CLI::App& program, const std::string& welcome) {
  CLI::App* command =
      program
          .add_subcommand(
              "manual",
              "The manual page palpa(1) in roff, on standard output: palpa manual | man -l -")
          ->group("");
  const auto completion = std::make_shared<bool>(false);
  command->add_flag("--completion", *completion, "Instead: a completion for bash");
  command->footer("Examples:\n  palpa manual | man -l -\n  source <(palpa manual --completion)");
  command->callback([&program, welcome, completion] {
    const CommandText text = describe(program);
    std::fputs(
        (*completion ? bashCompletion(text) : manualPage(text, "palpa " PALPA_VERSION, welcome))
            .c_str(),
        stdout);
  });
}

}  // namespace palpa::cli
