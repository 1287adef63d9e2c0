#pragma once

#include <functional>
#include <string>

namespace palpa::scene {

/// How the words that are drawn are said: in the language of whoever looks. As it is drawn, so it
/// is measured. Chosen once for a process, before its first window; until then as they are.
using Wording = std::function<std::string(const std::string&)>;
void sayThrough(Wording wording);
std::string said(const std::string& english);

}  // namespace palpa::scene
