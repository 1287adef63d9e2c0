#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "anatomy/base/bytes.h"

namespace palpa::record {

/// Bytes of `count` records of `record_size`, turned from rows into columns: byte k of all records
/// lies together. Slowly changing fields then give long runs, which zlib's fastest level packs
/// well.
Bytes transposed(ByteView records, std::size_t record_size);
Bytes untransposed(ByteView columns, std::size_t record_size);

/// Transposed, then deflated at zlib's fastest level (with its Adler-32).
Bytes packRecords(ByteView records, std::size_t record_size);

/// The inverse. `count` x `record_size` bytes must come out exactly; nullopt: the blob is damaged.
std::optional<Bytes> unpackRecords(ByteView blob, std::size_t record_size, std::size_t count);

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
