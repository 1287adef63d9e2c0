#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "apps/report/html.h"

namespace palpa::calibrate {

/// What the pages of this folder have in common: head, style, title, who and when, the word
/// SIMULATED.
struct PageFrame {
  std::string window, heading;                           ///< title of the window, of the page
  std::vector<std::pair<std::string, std::string>> who;  ///< "Station", its name
  std::string simulated;                                 ///< what that means here; empty: it is not
  std::string style;                                     ///< besides the pages' common one
};

/// `top`: the header's rest; `main`: the page. Written whole. Throws Error.
void writeFramed(const PageFrame& frame, const std::function<void(report::Html&)>& top,
                 const std::function<void(report::Html&)>& main, const std::filesystem::path& file);

/// A row of a table of facts: what, how much, and what to think of it.
void writeFact(report::Html& html, const std::string& name, const std::string& value,
               const std::string& note);

}  // namespace palpa::calibrate
