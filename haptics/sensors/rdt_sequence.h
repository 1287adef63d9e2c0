#pragma once

#include <cstdint>

#include "haptics/sensors/rdt_protocol.h"

namespace palpa::haptics {

enum class RdtVerdict : std::uint8_t {
  fresh,      ///< newer than all before
  duplicate,  ///< the newest one again
  late        ///< older than the newest: overtaken on the way
};

/// Where the stream is. Trivially copyable.
struct RdtSequence {
  std::uint32_t rdt = 0;
  std::uint32_t ft = 0;
  bool known = false;  ///< false: the next record starts a stream, whatever its numbers
};

struct RdtStep {
  RdtVerdict verdict = RdtVerdict::fresh;
  std::uint32_t missing = 0;  ///< records between the newest one and this
};

/// Judges a record by its numbers (both wrap at 2^32) and advances the state when it is fresh.
/// A request to start makes rdt_sequence begin again while ft_sequence runs on: a record with an
/// older rdt_sequence but a newer ft_sequence therefore belongs to a new stream, and is fresh. One
/// with an older ft_sequence is late in any case.
RdtStep advance(RdtSequence& state, const RdtRecord& record) noexcept;

}  // namespace palpa::haptics
