#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "haptics/sensors/force_sensor.h"

/// Raw Data Transfer of the ATI Net F/T and Ethernet Axia sensors: UDP, port 49152, big-endian.
/// Source: ATI manuals 9620-05-NET FT and 9610-05-Ethernet Axia.
///
///   request, 8 bytes: u16 0x1234, u16 command, u32 number of samples (0: until stopped)
///   record, 36 bytes: u32 rdt_sequence, u32 ft_sequence, u32 status, i32 Fx Fy Fz Tx Ty Tz, counts
///
/// A datagram of a buffered stream holds several records. One client at a time.
namespace palpa::haptics {

inline constexpr std::uint16_t kRdtPort = 49152;
inline constexpr std::uint16_t kRdtStop = 0;
inline constexpr std::uint16_t kRdtStart = 2;  ///< Net F/T; models differ, so it is a setting
inline constexpr std::uint16_t kRdtSoftwareBias = 0x42;
inline constexpr std::size_t kRdtRecordBytes = 36;
/// Most in one Ethernet frame (1500 bytes with 28 of headers).
inline constexpr std::size_t kRdtDatagramBytes = 40 * kRdtRecordBytes;

using RdtRequest = std::array<std::uint8_t, 8>;
RdtRequest rdtRequest(std::uint16_t command, std::uint32_t samples = 0) noexcept;

struct RdtRecord {
  std::uint32_t rdt_sequence = 0;  ///< from 1 in each stream, +1 a record
  std::uint32_t ft_sequence = 0;   ///< internal sample counter; a request does not reset it
  std::uint32_t status = 0;        ///< 0: good
  std::array<std::int32_t, 3> force_counts{};
  std::array<std::int32_t, 3> torque_counts{};
};

/// Records in a datagram of that length; 0 when the length is no whole number of records, or more
/// than fits into one Ethernet frame: then nothing in it is trusted.
std::size_t rdtRecordCount(std::size_t datagram_bytes) noexcept;

RdtRecord rdtRecord(std::span<const std::uint8_t, kRdtRecordBytes> bytes) noexcept;

/// Counts in one newton and one newton metre: `cfgcpf` and `cfgcpt` of
/// http://<sensor>/netftapi2.xml when the sensor's configuration states N and Nm.
struct RdtScale {
  double counts_per_N = 1e6;
  double counts_per_Nm = 1e6;
};

/// Force, torque, ft_sequence, status and kFault. Time, sequence and the other flags are the
/// caller's.
WrenchSample rdtWrench(const RdtRecord& record, const RdtScale& scale) noexcept;

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
