#pragma once

#include <igtlClientSocket.h>
#include <igtlMessageHeader.h>
#include <igtlSensorMessage.h>
#include <igtlServerSocket.h>
#include <igtlStatusMessage.h>
#include <igtlStringMessage.h>
#include <igtlTrackingDataMessage.h>
#include <igtlTransformMessage.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/link/igtl/wire.h"

/// The library's own client and server as the other side.
namespace palpa::igt_test {

/// A message as the library took it in.
struct Got {
  std::string type, device;
  std::int64_t utc_ns = 0;
  int header_version = 0;
  bool whole = false;                 ///< the library found body and checksum right
  Mat4 X_mm = Mat4::Identity();       ///< TRANSFORM
  std::map<std::string, Mat4> tools;  ///< TDATA
  std::vector<double> values;         ///< SENSOR
  std::uint64_t unit = 0;
  std::string text;  ///< STRING, STATUS
  int encoding = 0;
  int answer = -1;  ///< RTS_TDATA
};

class LibraryClient {
 public:
  explicit LibraryClient(std::uint16_t port);
  ~LibraryClient() { socket_->CloseSocket(); }
  bool connected() const { return connected_; }
  /// The next message that is there, after at most `wait_ms`.
  std::optional<Got> next(int wait_ms = 200);
  /// Everything that is there.
  std::vector<Got> all();
  void send(const igt::Bytes& bytes) {
    socket_->Send(bytes.data(), static_cast<int>(bytes.size()));
  }
  void ask(igtl::MessageBase& message);
  void startTracking(int resolution_ms, const std::string& coordinates);
  void stopTracking();
  void close() { socket_->CloseSocket(); }

 private:
  igtl::ClientSocket::Pointer socket_ = igtl::ClientSocket::New();
  bool connected_ = false;
};

/// Of those with this device name, the last.
std::optional<Got> lastOf(const std::vector<Got>& messages, const std::string& device);
int countOf(const std::vector<Got>& messages, const std::string& type);

/// Plays a PLUS server: one connection at a time.
class LibraryServer {
 public:
  explicit LibraryServer(int port = 0);
  ~LibraryServer() { stop(); }
  int port() const { return port_; }
  bool accept(int wait_ms);
  void send(const igt::Bytes& bytes) { peer_->Send(bytes.data(), static_cast<int>(bytes.size())); }
  void hangUp();
  void stop();
  igtl::ClientSocket& peer() { return *peer_; }

 private:
  igtl::ServerSocket::Pointer server_ = igtl::ServerSocket::New();
  igtl::ClientSocket::Pointer peer_;
  int port_ = 0;
};

/// A header alone, of any type and size; what its body is to be is not said.
igt::Bytes headerOf(const std::string& type, std::uint64_t body_size);
/// The same message with the checksum that its body has now.
igt::Bytes withChecksum(igt::Bytes message);
/// A message with header version 2 and metadata, by the specification of protocol 3, made of one
/// with version 1.
igt::Bytes withMetadata(const igt::Bytes& version1,
                        const std::vector<std::pair<std::string, std::string>>& metadata);

}  // namespace palpa::igt_test
