#pragma once

#include <cstdint>
#include <string_view>

#include "apps/record/bytes.h"

namespace palpa::record {

/// CRC-32 (ISO 3309, as in zlib) over a row's values in order, each led by its length, so that no
/// two rows of different columns look alike. SQLite itself does not notice a flipped bit in a
/// value.
class RowChecksum {
 public:
  RowChecksum& add(std::int64_t value);
  RowChecksum& add(int value) { return add(static_cast<std::int64_t>(value)); }
  RowChecksum& add(double value);  ///< every not-a-number counts as the same
  RowChecksum& add(std::string_view value);
  RowChecksum& add(ByteView value);
  std::int64_t value() const { return static_cast<std::int64_t>(crc_); }

 private:
  void update(const void* data, std::size_t size);
  std::uint32_t crc_ = 0;
};

template <typename... Values>
std::int64_t rowChecksum(const Values&... values) {
  RowChecksum sum;
  (sum.add(values), ...);
  return sum.value();
}

}  // namespace palpa::record
