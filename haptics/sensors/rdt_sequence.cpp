#include "haptics/sensors/rdt_sequence.h"

namespace palpa::haptics {
namespace {

/// Signed distance of two counters that wrap.
std::int32_t ahead(std::uint32_t a, std::uint32_t b) noexcept {
  return static_cast<std::int32_t>(a - b);
}

}  // namespace

RdtStep advance(RdtSequence& state, const RdtRecord& record) noexcept {
  RdtStep step;
  if (state.known) {
    const std::int32_t by = ahead(record.rdt_sequence, state.rdt);
    const std::int32_t ft_by = ahead(record.ft_sequence, state.ft);
    if (by == 0 && ft_by == 0) return {RdtVerdict::duplicate, 0};
    const bool new_stream = by <= 0 && ft_by > 0;
    if (!new_stream && (by <= 0 || ft_by < 0)) return {RdtVerdict::late, 0};
    if (!new_stream) step.missing = static_cast<std::uint32_t>(by - 1);
  }
  state = {record.rdt_sequence, record.ft_sequence, true};
  return step;
}

}  // namespace palpa::haptics
