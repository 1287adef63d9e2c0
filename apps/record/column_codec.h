#pragma once

#include <cstddef>
#include <optional>

#include "apps/record/bytes.h"

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

}  // namespace palpa::record
