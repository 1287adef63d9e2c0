#include "anatomy/base/json_text.h"

namespace palpa {

using nlohmann::json;

json parseJson(std::string_view text) { return json::parse(text); }

json parseJson(std::string_view text, int deepest, const std::function<void()>& too_deep) {
  return json::parse(text, [&](int depth, json::parse_event_t, json&) {
    if (depth > deepest) too_deep();
    return true;
  });
}

json parsedOrDiscarded(std::string_view text) { return json::parse(text, nullptr, false); }

}  // namespace palpa
