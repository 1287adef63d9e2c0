#pragma once

#include <string>
#include <vector>

namespace palpa::cli {

/// Takes every "--language CODE" and "--language=CODE" away; what the last one says, or nothing.
/// Throws UsageError where the code lacks.
std::string takeLanguage(std::vector<std::string>* words);

/// From here on this process speaks the language that is wished (`given`, else what the environment
/// says): window, pages and terminal. What a console reads (`words` has --live) stays English on
/// the terminal and in files; whoever shows it says it in his language. Once, before any thread.
/// Throws UsageError for a language that is not there.
void speakTo(const std::vector<std::string>& words, const std::string& given);

}  // namespace palpa::cli
