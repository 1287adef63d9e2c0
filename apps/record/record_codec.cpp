#include "apps/record/record_codec.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace palpa::record {

namespace {

/// `rows` of `columns` bytes as columns of rows, in tiles that stay in the processor's cache: a
/// byte at a time along a column of all rows misses it at every byte.
Bytes turned(ByteView bytes, std::size_t rows, std::size_t columns) {
  constexpr std::size_t kTile = 64;
  Bytes result(bytes.size());
  for (std::size_t row = 0; row < rows; row += kTile)
    for (std::size_t column = 0; column < columns; column += kTile)
      for (std::size_t c = column; c < std::min(column + kTile, columns); ++c) {
        const std::uint8_t* from = bytes.data() + c;
        std::uint8_t* to = result.data() + c * rows;
        for (std::size_t r = row; r < std::min(row + kTile, rows); ++r) to[r] = from[r * columns];
      }
  return result;
}

}  // namespace

Bytes transposed(ByteView records, std::size_t record_size) {
  return turned(records, records.size() / record_size, record_size);
}

Bytes untransposed(ByteView columns, std::size_t record_size) {
  return turned(columns, record_size, columns.size() / record_size);
}

namespace {

/// What compress2 makes, to the byte, with one working memory (268 kB) for all that a thread packs:
/// to get it and give it back costs as much as to pack a snapshot.
class Deflater {
 public:
  Deflater() {
    if (deflateInit(&stream_, Z_BEST_SPEED) != Z_OK) throw std::bad_alloc();
  }
  ~Deflater() { deflateEnd(&stream_); }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  Bytes pack(Bytes bytes) {
    deflateReset(&stream_);
    Bytes blob(deflateBound(&stream_, static_cast<uLong>(bytes.size())));
    stream_.next_in = bytes.data();
    stream_.avail_in = static_cast<uInt>(bytes.size());
    stream_.next_out = blob.data();
    stream_.avail_out = static_cast<uInt>(blob.size());
    if (deflate(&stream_, Z_FINISH) != Z_STREAM_END)
      throw std::bad_alloc();  // the only way left for it to fail
    blob.resize(stream_.total_out);
    return blob;
  }

 private:
  z_stream stream_{};
};

}  // namespace

Bytes packRecords(ByteView records, std::size_t record_size) {
  thread_local Deflater deflater;
  return deflater.pack(transposed(records, record_size));
}

std::optional<Bytes> unpackRecords(ByteView blob, std::size_t record_size, std::size_t count) {
  Bytes columns(count * record_size);
  uLongf size = static_cast<uLongf>(columns.size());
  uLong used = static_cast<uLong>(blob.size());
  if (uncompress2(columns.data(), &size, blob.data(), &used) != Z_OK) return std::nullopt;
  if (size != columns.size() || used != blob.size()) return std::nullopt;
  return untransposed(columns, record_size);
}

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
