#pragma once

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "anatomy/base/error.h"

namespace palpa {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

/// The bytes of trivially copyable records, padding included.
template <typename Record>
ByteView bytesOf(const Record* records, std::size_t count) {
  static_assert(std::is_trivially_copyable_v<Record>);
  return {reinterpret_cast<const std::uint8_t*>(records), count * sizeof(Record)};
}

/// Walks through bytes that nobody vouches for: lines, words, numbers, binary values. Never past
/// the end.
class ByteReader {
 public:
  /// Messages name `where` and end with `remedy`.
  ByteReader(std::string_view bytes, std::string where, std::string remedy)
      : bytes_(bytes), where_(std::move(where)), remedy_(std::move(remedy)) {}

  [[noreturn]] void fail(const std::string& what) const { throw Error(what, where_, remedy_); }
  bool done() const { return at_ >= bytes_.size(); }
  std::size_t left() const { return bytes_.size() - at_; }

  /// The next line without its end; a lone CR counts as an end, too.
  std::string_view line() {
    const std::size_t end = bytes_.find_first_of("\r\n", at_);
    const std::size_t stop = end == std::string_view::npos ? bytes_.size() : end;
    const std::string_view text = bytes_.substr(at_, stop - at_);
    at_ = stop;
    if (at_ < bytes_.size() && bytes_[at_] == '\r') ++at_;
    if (at_ < bytes_.size() && bytes_[at_] == '\n' && (at_ == stop || bytes_[at_ - 1] == '\r'))
      ++at_;
    return text;
  }

  /// The next word of `text`, taken off it; empty at its end.
  static std::string_view word(std::string_view& text) {
    const std::size_t begin = text.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return text = {};
    const std::size_t end = std::min(text.find_first_of(" \t", begin), text.size());
    const std::string_view found = text.substr(begin, end - begin);
    text.remove_prefix(end);
    return found;
  }

  /// The next word across lines.
  std::string_view word() {
    const std::size_t begin = bytes_.find_first_not_of(" \t\r\n", at_);
    if (begin == std::string_view::npos) fail("it ends too early");
    const std::size_t end = std::min(bytes_.find_first_of(" \t\r\n", begin), bytes_.size());
    at_ = end;
    return bytes_.substr(begin, end - begin);
  }

  double number(std::string_view text) const {
    double value = 0;
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
      fail("\"" + std::string(text.substr(0, 24)) + "\" is not a number");
    return value;
  }

  long long whole(std::string_view text) const {
    long long value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
      fail("\"" + std::string(text.substr(0, 24)) + "\" is not a whole number");
    return value;
  }

  /// A binary value of type T; `swapped`: the other byte order.
  template <class T>
  T take(bool swapped = false) {
    if (left() < sizeof(T)) fail("it ends too early");
    char raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    if (swapped) std::reverse(raw, raw + sizeof(T));
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }

  void skip(std::size_t count) {
    if (left() < count) fail("it ends too early");
    at_ += count;
  }

 private:
  std::string_view bytes_;
  std::string where_, remedy_;
  std::size_t at_ = 0;
};

}  // namespace palpa
