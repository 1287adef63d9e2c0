#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace palpa::record {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

/// The bytes of trivially copyable records, padding included.
template <typename Record>
ByteView bytesOf(const Record* records, std::size_t count) {
  static_assert(std::is_trivially_copyable_v<Record>);
  return {reinterpret_cast<const std::uint8_t*>(records), count * sizeof(Record)};
}

}  // namespace palpa::record
