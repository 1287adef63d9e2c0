#include "apps/record/schema.h"

#include <bit>

#include "haptics/flight_record.h"
#include "haptics/loop/tick_config.h"
#include "haptics/loop/tick_state.h"

namespace palpa::record {

const char* schemaSql() {
  return R"sql(
CREATE TABLE meta(              -- what the session says of itself
  key   TEXT PRIMARY KEY,
  value NOT NULL,               -- TEXT; BLOB for patient_glb and tick_config
  crc   INTEGER NOT NULL
) WITHOUT ROWID;

CREATE TABLE trials(
  trial            INTEGER PRIMARY KEY,   -- 1, 2, ...
  t_ns             INTEGER NOT NULL,      -- session time of the start
  seed             INTEGER NOT NULL,      -- the 64 bits of an unsigned number
  role             TEXT NOT NULL,
  force_feedback   INTEGER NOT NULL,
  puncture_force_N REAL,
  crc              INTEGER NOT NULL,      -- of the columns above
  end_t_ns         INTEGER,               -- NULL from here on: the process stopped in the middle
  outcome          TEXT,
  reason           TEXT,
  scores_json      TEXT,
  end_crc          INTEGER                -- of trial and the end's columns
);

CREATE TABLE events(
  id    INTEGER PRIMARY KEY,    -- in the order of recording
  t_ns  INTEGER NOT NULL,
  trial INTEGER NOT NULL,       -- 0: outside a trial
  kind  TEXT NOT NULL,
  text  TEXT NOT NULL,
  value REAL,                   -- NULL: not a number
  crc   INTEGER NOT NULL
);

CREATE TABLE ticks(
  first_tick  INTEGER PRIMARY KEY,
  count       INTEGER NOT NULL, -- records in the chunk, 1 to 200
  record_size INTEGER NOT NULL, -- bytes of one
  blob        BLOB NOT NULL,    -- FlightRecords: bytes transposed, then zlib
  crc         INTEGER NOT NULL
);

CREATE TABLE snapshots(
  number INTEGER PRIMARY KEY,
  t_ns   INTEGER NOT NULL,
  blob   BLOB NOT NULL,         -- LocalGeometry, zlib
  crc    INTEGER NOT NULL
);

CREATE TABLE keyframes(
  tick INTEGER PRIMARY KEY,
  blob BLOB NOT NULL,           -- TickState, zlib
  crc  INTEGER NOT NULL
);
)sql";
}

namespace {

template <typename Record>
std::string sized(const char* name) {
  return std::string("; ") + name + ' ' + std::to_string(sizeof(Record));
}

}  // namespace

std::string layoutText() {
  using namespace haptics;
  const char* order = std::endian::native == std::endian::little ? "little-endian" : "big-endian";
  return "layout " + std::to_string(kLayoutVersion) + ", " + order +
         sized<FlightRecord>("FlightRecord") + sized<DeviceReading>("DeviceReading") +
         sized<TickCommands>("TickCommands") + sized<PulsingArtery>("PulsingArtery") +
         sized<LocalGeometry>("LocalGeometry") + sized<Capsule>("Capsule") +
         sized<Boundary>("Boundary") + sized<TickState>("TickState") +
         sized<NeedleState>("NeedleState") + sized<SafetyState>("SafetyState") +
         sized<TickConfig>("TickConfig") + sized<PairConfig>("PairConfig") +
         sized<NeedleMaterials>("NeedleMaterials") + sized<SafetyLimits>("SafetyLimits");
}

}  // namespace palpa::record
