#include "apps/cli/usage_words.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <new>
#include <opencv2/core.hpp>
#include <system_error>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/cli/command_tree.h"
#include "apps/cli/values.h"

namespace palpa::cli {
namespace {

/// The program, the command that was given, the one below it: the last is the command at hand.
using Chain = std::vector<const CLI::App*>;

Chain chainOf(const CLI::App& program) {
  Chain chain{&program};
  while (!chain.back()->get_subcommands().empty())
    chain.push_back(chain.back()->get_subcommands().front());
  return chain;
}

std::string pathOf(const Chain& chain, const CLI::App* last) {
  std::string path;
  for (const CLI::App* app : chain) {
    path += (path.empty() ? "" : " ") + app->get_name();
    if (app == last) break;
  }
  return path;
}

std::vector<std::string> commandsOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* below :
       app.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); }))
    names.push_back(below->get_name());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> optionNames(const CLI::App& app) {
  std::vector<std::string> names{"--verbose"};
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

bool isOption(const CLI::App& app, const std::string& name) {
  const std::vector<std::string> names = optionNames(app);
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// "--task FILE", "session FILE".
std::string labelOf(const CLI::Option& option) {
  const OptionText text = describe(option);
  const std::string name = option.get_name();
  return text.value.empty() || text.value == name ? name : name + " " + text.value;
}

bool takesNothing(const CLI::Option& option) { return option.get_expected_max() == 0; }

// ---- a word too many

std::string has(const Chain& chain, const CLI::App& app) {
  return &app == chain.front() ? "there is " : pathOf(chain, &app) + " has ";
}

std::string unknownOption(const Chain& chain, const CLI::App& app, const std::string& typed) {
  const std::string name = typed.substr(0, typed.find('='));
  const CLI::App& at = *chain.back();
  if (&app != &at && isOption(at, name))
    return name + " stands before the command it belongs to; write: " + pathOf(chain, &at) + " " +
           name;
  const std::string whole = name.rfind("--", 0) == 0 ? name : "-" + name;
  const std::string meant =
      isOption(app, whole) ? "; did you mean " + whole + "?" : proposal(whole, optionNames(app));
  return has(chain, app) + "no option " + name + meant;
}

std::string unknownCommand(const Chain& chain, const CLI::App& app, const std::string& typed) {
  const std::vector<std::string> known = commandsOf(app);
  const std::string near = proposal(typed, known);
  return has(chain, app) + "no command " + quoted(typed) + (near.empty() ? "." : near) + " There " +
         (known.size() == 1 ? "is " : "are ") + listed(known, "and");
}

std::string strayWord(const Chain& chain, const CLI::App& app, const std::string& typed) {
  const auto taken = app.get_options([](const CLI::Option* one) { return one->get_positional(); });
  const std::string path = pathOf(chain, &app);
  if (isOption(app, "--" + typed))
    return path + " takes no word " + quoted(typed) + "; did you mean --" + typed + "?";
  if (taken.empty()) return path + " takes no word " + quoted(typed) + " without an option";
  return path + " takes " + labelOf(*taken.front()) + " only once; " + quoted(typed) +
         " is too many";
}

std::string wordTooMany(const Chain& chain, const CLI::App& app, const std::string& typed) {
  if (typed.size() > 1 && typed[0] == '-') return unknownOption(chain, app, typed);
  if (!commandsOf(app).empty() && app.get_subcommands().empty())
    return unknownCommand(chain, app, typed);
  return strayWord(chain, app, typed);
}

/// The first word that nobody took; empty: none.
std::string extraWords(const Chain& chain) {
  for (const CLI::App* app : chain)
    if (const std::vector<std::string> left = app->remaining(false); !left.empty())
      return wordTooMany(chain, *app, left.front());
  return "";
}

/// An option that took the next one's name for its value.
std::string swallowedOption(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    for (const std::string& value : option->results())
      if (value.rfind("--", 0) == 0 && isOption(app, value))
        return labelOf(*option) + " lacks its value: " + value + " follows it";
  return "";
}

// ---- what is missing, what does not go together

std::string missing(const Chain& chain) {
  std::vector<std::string> needed;
  const CLI::App& at = *chain.back();
  for (const CLI::Option* option : at.get_options())
    if (option->get_required() && option->count() == 0) needed.push_back(labelOf(*option));
  if (!needed.empty()) return pathOf(chain, &at) + " needs " + listed(needed, "and");
  const std::vector<std::string> known = commandsOf(at);
  return pathOf(chain, &at) + " needs to know what to do: " + listed(known);
}

std::string unmetNeed(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    for (const CLI::Option* needed : option->get_needs())
      if (option->count() > 0 && needed->count() == 0)
        return option->get_name() + " goes only with " + labelOf(*needed) +
               ": add that, or leave it out";
  return "";
}

std::string contradiction(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    for (const CLI::Option* other : option->get_excludes())
      if (option->count() > 0 && other->count() > 0)
        return option->get_name() + " and " + other->get_name() +
               " do not go together: leave one of them out";
  return "";
}

// ---- a value

/// The option that the library's message names first.
const CLI::Option* optionIn(const std::string& message, const CLI::App& app) {
  const CLI::Option* found = nullptr;
  std::size_t first = std::string::npos, longest = 0;
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    const std::size_t at = message.find(name);
    if (at == std::string::npos || at > first || (at == first && name.size() < longest)) continue;
    found = option;
    first = at;
    longest = name.size();
  }
  return found;
}

std::string wrongNumberOfValues(const CLI::Option& option) {
  const std::string label = labelOf(option);
  const int least = option.get_items_expected_min();
  if (takesNothing(option)) return option.get_name() + " stands alone, without a value";
  if (static_cast<int>(option.results().size()) > option.get_items_expected_max())
    return label + " is given more than once";
  return label + (least > 1 ? " needs " + std::to_string(least) + " values" : " needs a value");
}

std::string unreadValue(const CLI::Option& option) {
  if (takesNothing(option)) return option.get_name() + " stands alone, without a value";
  const std::vector<std::string>& values = option.results();
  const bool number = describe(option).value == "NUMBER";
  return option.get_name() + (number ? " needs a number that fits it, not " : " cannot be ") +
         quoted(values.empty() ? "" : values.back());
}

/// "--seed: needs ..." becomes "--seed needs ..."; our own values' words (values.h).
std::string refusedValue(const std::string& message) {
  const std::size_t colon = message.find(": ");
  if (colon == std::string::npos || message.compare(colon + 2, 6, "needs ") != 0) return message;
  return message.substr(0, colon) + message.substr(colon + 1);
}

std::string wordsOf(const CLI::ParseError& error, const Chain& chain) {
  const CLI::App& at = *chain.back();
  const std::string message = error.what();
  std::string words = swallowedOption(at);
  if (words.empty()) words = extraWords(chain);
  if (words.empty() && dynamic_cast<const CLI::ValidationError*>(&error))
    words = refusedValue(message);
  if (words.empty() && dynamic_cast<const CLI::RequiredError*>(&error)) words = missing(chain);
  if (words.empty() && dynamic_cast<const CLI::RequiresError*>(&error)) words = unmetNeed(at);
  if (words.empty() && dynamic_cast<const CLI::ExcludesError*>(&error)) words = contradiction(at);
  if (const CLI::Option* option = words.empty() ? optionIn(message, at) : nullptr)
    words = dynamic_cast<const CLI::ConversionError*>(&error) ? unreadValue(*option)
                                                              : wrongNumberOfValues(*option);
  return words.empty() ? "this cannot be read as a command" : words;
}

}  // namespace

std::string usageWords(const CLI::ParseError& error, const CLI::App& program) {
  const Chain chain = chainOf(program);
  const std::string words = wordsOf(error, chain);
  const bool ends = words.back() == '?' || words.back() == '.';
  return words + (ends ? "" : ".") + " See: " + pathOf(chain, chain.back()) + " --help";
}

void refuseLackingValues(const CLI::App& program) {
  const Chain chain = chainOf(program);
  if (!swallowedOption(*chain.back()).empty())
    throw CLI::ValidationError(chain.back()->get_name(), "lacks a value");
}

namespace {

constexpr const char* kNoMemory =
    "there is not enough memory for this. Close other programs, allow palpa more (ulimit -v), or "
    "give it something smaller";

/// Of a file that was to be read, made, renamed or removed.
std::string whyUnused(const std::error_code& code) {
  const bool forbidden =
      code == std::errc::permission_denied || code == std::errc::operation_not_permitted;
  return forbidden ? "you may not do this with it" : whyUnread(code);
}

/// `file`: what it was about; empty: not known.
std::string refusedBySystem(const std::string& file, const std::error_code& code, bool verbose) {
  if (code == std::errc::not_enough_memory) return kNoMemory;
  if (code == std::errc::resource_unavailable_try_again)
    return "the system allows no more threads or processes now. End other programs, or raise the "
           "limit (ulimit -u)";
  if (code == std::errc::too_many_files_open)
    return "the system allows no more open files. Raise the limit (ulimit -n)";
  const std::string words =
      file.empty()
          ? "the system refuses something (" + fileTrouble(code.value()).why +
                "). See to that, then try again"
          : file + ": cannot be used (" + whyUnused(code) + "). Check its name, and who may use it";
  return verbose ? words + "; the system said: " + code.message() : words;
}

std::string unforeseen(const std::string& said, bool verbose) {
  return verbose ? "something failed that was not foreseen; a library said: " + said
                 : "something failed that was not foreseen. Once more with --verbose says what, "
                   "for whoever looks after this station";
}

}  // namespace

FailureWords failureWords(const std::exception_ptr& thrown, bool verbose) {
  try {
    std::rethrow_exception(thrown);
  } catch (const UsageError& e) {
    return {e.what(), 2};
  } catch (const Error& e) {
    return {e.what(), 1};
  } catch (const std::bad_alloc&) {
    return {kNoMemory, 1};
  } catch (const cv::Exception& e) {
    return {e.code == cv::Error::StsNoMem ? kNoMemory : unforeseen(e.what(), verbose), 1};
  } catch (const std::filesystem::filesystem_error& e) {
    return {refusedBySystem(e.path1().string(), e.code(), verbose), 1};
  } catch (const std::system_error& e) {
    return {refusedBySystem("", e.code(), verbose), 1};
  } catch (const std::exception& e) {
    return {unforeseen(e.what(), verbose), 1};
  } catch (...) {
    return {unforeseen("nothing", verbose), 1};
  }
}

int complain(const std::string& text, int exit_code) {
  std::string line = text.substr(0, text.find('\n'));
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';  // no orders to the terminal
  std::fprintf(stderr, "palpa: %s\n", line.c_str());
  return exit_code;
}

}  // namespace palpa::cli
