#pragma once

#include <cstdint>
#include <string>

namespace palpa::record {

/// "palp" in SQLite's header: `file session.palpa` can name it.
inline constexpr std::int64_t kApplicationId = 0x70616c70;

/// Version of tables and columns (SQLite's user_version).
inline constexpr std::int64_t kSchemaVersion = 1;

/// Version of the meaning of the binary records; their sizes are compared besides. Raise it when a
/// field of a recorded struct changes its meaning, unit, type or place.
inline constexpr int kLayoutVersion = 9;

/// Ticks in one chunk at most: what a killed process can lose.
inline constexpr std::size_t kChunkTicks = 200;

/// All tables. Every row ends with `crc`: CRC-32 of its other columns (record_codec.h).
const char* schemaSql();

/// Byte order, layout version and size of every recorded struct: equal text, equal layout.
std::string layoutText();

}  // namespace palpa::record
