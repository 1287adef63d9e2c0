#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/browser/browser.h"

namespace palpa::test {

/// What a reader would trip over, a line each; empty: nothing. Looked at on a desk (1100 px), a
/// tablet (800), a telephone (400), in the dark, and on paper: wider than the screen, type below 9
/// px, words of a drawing that run into each other or out of it, words that hardly differ from what
/// is behind them, errors on the console. Leaves a picture of each beside the page:
/// <page>-<width>.png.
std::vector<std::string> faultsOf(Browser& browser, const std::filesystem::path& page);

}  // namespace palpa::test
