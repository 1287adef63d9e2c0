#include <map>

#include "apps/cli/manual_page.h"

namespace palpa::cli {
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

}  // namespace palpa::cli
