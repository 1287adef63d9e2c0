#include "scene/overlay/wording.h"

#include <map>

namespace palpa::scene {
namespace {

constexpr std::size_t kRemembered = 500;  // texts: most stand for many frames

thread_local std::map<std::string, std::string> known;
Wording& ofProcess() {
  static Wording wording;
  return wording;
}

}  // namespace

void sayThrough(Wording wording) { ofProcess() = std::move(wording); }

std::string said(const std::string& english) {
  if (!ofProcess() || english.empty()) return english;
  if (const auto found = known.find(english); found != known.end()) return found->second;
  if (known.size() > kRemembered) known.clear();
  return known[english] = ofProcess()(english);
}

}  // namespace palpa::scene
