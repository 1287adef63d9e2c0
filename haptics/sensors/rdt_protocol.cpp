#include "haptics/sensors/rdt_protocol.h"

namespace palpa::haptics {
namespace {

constexpr std::uint16_t kRdtHeader = 0x1234;

std::uint32_t bigEndian32(const std::uint8_t* at) noexcept {
  return std::uint32_t{at[0]} << 24 | std::uint32_t{at[1]} << 16 | std::uint32_t{at[2]} << 8 |
         at[3];
}

}  // namespace

RdtRequest rdtRequest(std::uint16_t command, std::uint32_t samples) noexcept {
  const auto byte = [](std::uint32_t value, int shift) {
    return static_cast<std::uint8_t>(value >> shift);
  };
  return {byte(kRdtHeader, 8), byte(kRdtHeader, 0), byte(command, 8), byte(command, 0),
          byte(samples, 24),   byte(samples, 16),   byte(samples, 8), byte(samples, 0)};
}

std::size_t rdtRecordCount(std::size_t datagram_bytes) noexcept {
  if (datagram_bytes > kRdtDatagramBytes || datagram_bytes % kRdtRecordBytes != 0) return 0;
  return datagram_bytes / kRdtRecordBytes;
}

RdtRecord rdtRecord(std::span<const std::uint8_t, kRdtRecordBytes> bytes) noexcept {
  const std::uint8_t* at = bytes.data();
  RdtRecord record{bigEndian32(at), bigEndian32(at + 4), bigEndian32(at + 8), {}, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    record.force_counts[i] = static_cast<std::int32_t>(bigEndian32(at + 12 + 4 * i));
    record.torque_counts[i] = static_cast<std::int32_t>(bigEndian32(at + 24 + 4 * i));
  }
  return record;
}

WrenchSample rdtWrench(const RdtRecord& record, const RdtScale& scale) noexcept {
  WrenchSample sample;
  for (std::size_t i = 0; i < 3; ++i) {
    sample.f_S[i] = record.force_counts[i] / scale.counts_per_N;
    sample.tau_S[i] = record.torque_counts[i] / scale.counts_per_Nm;
  }
  sample.ft_sequence = record.ft_sequence;
  sample.status = record.status;
  if (record.status != 0) sample.flags = kFault;
  return sample;
}

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
