#pragma once

#include <exception>
#include <string>

#include <CLI/CLI.hpp>

/// The one place that says in our words what went wrong: what was typed, and what is thrown as far
/// as `main`. No library's words leave it, unless they are asked for.
namespace palpa::cli {

/// Why the command line could not be read: the word at fault, the one that was probably meant, the
/// help of the command at hand. `program`: as the failed parse left it. For errors that are none
/// (--help, --version) use CLI::App::exit.
std::string usageWords(const CLI::ParseError& error, const CLI::App& program);

/// Of words that were all taken: throws where an option took the name of another one for its value
/// ("--out --fast"), for usageWords to tell.
void refuseLackingValues(const CLI::App& program);

struct FailureWords {
  std::string text;
  int exit_code = 1;
};

/// Of what was thrown: an Error's own words; for memory that ran out and what the system refuses,
/// what to do. `verbose`: what a library said is told as well.
FailureWords failureWords(const std::exception_ptr& thrown, bool verbose);

/// "palpa: TEXT" on standard error: one line, whatever the text holds; returns the code.
int complain(const std::string& text, int exit_code);

}  // namespace palpa::cli
