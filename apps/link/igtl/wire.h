#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "anatomy/geometry/pose.h"

/// OpenIGTLink messages as bytes; the only door to its library. Matrices are homogeneous, in
/// millimetres, single precision on the wire; times are ns of UTC since 1970.
namespace palpa::igt {

using Bytes = std::vector<std::uint8_t>;
using View = std::span<const std::uint8_t>;

struct NamedMatrix {
  std::string name;
  Mat4 X_mm = Mat4::Identity();
};
struct TrackingRequest {
  int resolution_ms = 0;    ///< least time between two messages; 0: as fast as the sender can
  std::string coordinates;  ///< in which frame; empty: the sender's own
};
enum class Quantity { newtons, millimetres };

// Written with header version 1, which receivers of every version read.
Bytes transformMessage(const std::string& device, const Mat4& X_mm, std::int64_t utc_ns);
Bytes trackingMessage(const std::string& device, const std::vector<NamedMatrix>& tools,
                      std::int64_t utc_ns);
Bytes sensorMessage(const std::string& device, std::vector<double> values, Quantity quantity,
                    std::int64_t utc_ns);
Bytes stringMessage(const std::string& device, const std::string& utf8, std::int64_t utc_ns);
Bytes statusMessage(const std::string& device, const std::string& text, std::int64_t utc_ns);
Bytes trackingAnswer(const std::string& device, bool granted, std::int64_t utc_ns);
Bytes startTrackingMessage(const std::string& device, const TrackingRequest& request,
                           std::int64_t utc_ns);
Bytes stopTrackingMessage(const std::string& device, std::int64_t utc_ns);

inline constexpr std::size_t kHeaderSize = 58;
inline constexpr std::size_t kLongestName = 20;
struct Header {
  int version = 0;
  std::string type, device;
  std::int64_t utc_ns = 0;  ///< 0: not given
  std::uint64_t body_size = 0, crc = 0;
};
/// Versions whose bodies are understood; the header's own fields lie alike in later ones, so that
/// these can be passed over by their size.
inline constexpr int kNewestVersion = 2, kNewestLikely = 15;
/// Nothing where these bytes are no header: a version that nobody has, a type that is not
/// printable.
std::optional<Header> readHeader(std::span<const std::uint8_t, kHeaderSize> bytes);
bool crcFits(const Header& header, View body);

/// A body without what header version 2 puts around it.
struct Content {
  View bytes;                                   ///< into the body
  std::map<std::string, std::string> metadata;  ///< empty with version 1
};
/// Nothing where the sizes in it do not add up.
std::optional<Content> contentOf(const Header& header, View body);

// Contents; nothing where the size is wrong. What is in the matrices is not looked at here.
std::optional<Mat4> readTransform(View content);
std::optional<std::vector<NamedMatrix>> readTracking(View content);
std::optional<TrackingRequest> readTrackingRequest(View content);

}  // namespace palpa::igt
