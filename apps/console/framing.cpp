#include "apps/console/framing.h"

#include <algorithm>
#include <optional>
#include <string>

namespace palpa::console {
namespace {

/// kLongestBody + 1: too much, whatever was said; nullopt: no whole number.
std::optional<std::size_t> lengthIn(const std::string& text) {
  constexpr std::size_t kDigits = 19;
  if (text.empty() ||
      !std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; }))
    return std::nullopt;
  return text.size() > kDigits ? kLongestBody + 1
                               : std::min<std::size_t>(std::stoull(text), kLongestBody + 1);
}

}  // namespace

Verdict judgeFraming(const httplib::Request& r) {
  for (const char* once :
       {"Host", "Origin", "Content-Length", "Content-Type", "X-Palpa-Page", "X-Palpa-Write"})
    if (r.get_header_value_count(once) > 1) return {400, std::string("says ") + once + " twice"};
  if (r.has_header("Transfer-Encoding")) return {411, "a body is sent with its length"};
  if (r.has_header("Content-Encoding")) return {415, "a body is not packed"};
  if (r.has_header("Range")) return {416, "parts of an answer are not to be had"};
  const bool stated = r.has_header("Content-Length");
  const std::optional<std::size_t> length =
      stated ? lengthIn(r.get_header_value("Content-Length")) : std::size_t{0};
  if (!length) return {400, "the body's length is no number"};
  if (r.method == "POST" && !stated) return {411, "a body is sent with its length"};
  if (r.method != "POST" && *length > 0) return {400, "only a POST has a body"};
  if (*length > kLongestBody) return {413, "is longer than 64 KiB"};
  return {};
}

}  // namespace palpa::console
