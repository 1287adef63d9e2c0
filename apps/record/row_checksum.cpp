#include "apps/record/row_checksum.h"

#include <zlib.h>

#include <cmath>
#include <limits>

namespace palpa::record {

void RowChecksum::update(const void* data, std::size_t size) {
  const std::uint64_t length = size;
  crc_ = static_cast<std::uint32_t>(
      crc32_z(crc_, reinterpret_cast<const Bytef*>(&length), sizeof(length)));
  if (size > 0) {
    crc_ = static_cast<std::uint32_t>(crc32_z(crc_, static_cast<const Bytef*>(data), size));
  }
}

RowChecksum& RowChecksum::add(std::int64_t value) {
  update(&value, sizeof(value));
  return *this;
}

RowChecksum& RowChecksum::add(double value) {
  if (std::isnan(value)) value = std::numeric_limits<double>::quiet_NaN();
  if (value == 0) value = 0;  // SQLite keeps no sign of zero
  update(&value, sizeof(value));
  return *this;
}

RowChecksum& RowChecksum::add(std::string_view value) {
  update(value.data(), value.size());
  return *this;
}

RowChecksum& RowChecksum::add(ByteView value) {
  update(value.data(), value.size());
  return *this;
}

}  // namespace palpa::record
