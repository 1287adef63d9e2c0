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

/// What came, and what was passed over.
struct StreamCounts {
  std::uint64_t messages = 0;  ///< whole, with the right checksum, of a type that is read here
  /// of other types, of later versions, or too large to be kept: passed over by their size
  std::uint64_t skipped = 0;
  std::uint64_t damaged = 0;  ///< dropped: wrong checksum, or sizes that do not add up
};

struct Message {
  Header header;
  Bytes content;
  std::map<std::string, std::string> metadata;
};

/// Messages out of a stream of bytes, however these come in pieces. Holds at most one message of
/// `kLargestBody`; what is larger, as a picture, is passed over by its size without being kept. A
/// header that cannot be one ends it: from there nobody knows where the next message begins.
class MessageStream {
 public:
  static constexpr std::size_t kLargestBody = 64 * 1024;
  static constexpr std::uint64_t kLargestSkip = 1ull << 30;  ///< a larger body is no OpenIGTLink

  /// Takes bytes; `next` must have returned nothing before, so that no more than one call's bytes
  /// wait.
  void feed(View bytes) { waiting_.insert(waiting_.end(), bytes.begin(), bytes.end()); }
  /// The next whole message; nothing: more bytes are needed, or `broken`.
  std::optional<Message> next();
  bool broken() const { return broken_; }
  const StreamCounts& counts() const { return counts_; }

 private:
  bool takeHeader();
  std::optional<Message> takeBody();
  void drop(std::size_t bytes) {
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(bytes));
  }

  Bytes waiting_;
  std::optional<Header> header_;  ///< whose body is waited for
  std::uint64_t skip_ = 0;        ///< bytes yet to be passed over
  bool broken_ = false;
  StreamCounts counts_;
};

}  // namespace palpa::igt
