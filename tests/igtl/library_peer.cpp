#include "library_peer.h"

#include <igtl_util.h>
#include <poll.h>

namespace palpa::igt_test {
namespace {

Mat4 matrixOf(igtl::Matrix4x4& m) {
  Mat4 X;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) X(row, column) = static_cast<double>(m[row][column]);
  return X;
}

/// Receives the body of `header` into a message of type M; null: damaged.
template <class M>
typename M::Pointer bodyOf(igtl::Socket& socket, igtl::MessageHeader& header) {
  typename M::Pointer message = M::New();
  message->SetMessageHeader(&header);
  message->AllocatePack();
  if (message->GetPackBodySize() > 0)
    socket.Receive(message->GetPackBodyPointer(), message->GetPackBodySize());
  return message->Unpack(1) & igtl::MessageHeader::UNPACK_BODY ? message : nullptr;
}

void takeTransform(igtl::Socket& socket, igtl::MessageHeader& header, Got& got) {
  const auto message = bodyOf<igtl::TransformMessage>(socket, header);
  if (!(got.whole = message)) return;
  igtl::Matrix4x4 m;
  message->GetMatrix(m);
  got.X_mm = matrixOf(m);
}

void takeTracking(igtl::Socket& socket, igtl::MessageHeader& header, Got& got) {
  const auto message = bodyOf<igtl::TrackingDataMessage>(socket, header);
  if (!(got.whole = message)) return;
  for (int i = 0; i < message->GetNumberOfTrackingDataElements(); ++i) {
    igtl::TrackingDataElement::Pointer element;
    message->GetTrackingDataElement(i, element);
    igtl::Matrix4x4 m;
    element->GetMatrix(m);
    got.tools[element->GetName()] = matrixOf(m);
  }
}

void takeSensor(igtl::Socket& socket, igtl::MessageHeader& header, Got& got) {
  const auto message = bodyOf<igtl::SensorMessage>(socket, header);
  if (!(got.whole = message)) return;
  for (unsigned int i = 0; i < message->GetLength(); ++i)
    got.values.push_back(message->GetValue(i));
  got.unit = message->GetUnit();
}

void takeRest(igtl::Socket& socket, igtl::MessageHeader& header, Got& got) {
  if (got.type == "STRING") {
    const auto message = bodyOf<igtl::StringMessage>(socket, header);
    if ((got.whole = message))
      got.text = message->GetString(), got.encoding = message->GetEncoding();
  } else if (got.type == "STATUS") {
    const auto message = bodyOf<igtl::StatusMessage>(socket, header);
    if ((got.whole = message)) got.text = message->GetStatusString();
  } else if (got.type == "RTS_TDATA") {
    const auto message = bodyOf<igtl::RTSTrackingDataMessage>(socket, header);
    if ((got.whole = message)) got.answer = message->GetStatus();
  } else {
    socket.Skip(header.GetBodySizeToRead());
  }
}

/// The library keeps its descriptor to itself.
struct Reach : igtl::ClientSocket {
  static int igtl::Socket::*descriptor() { return &Reach::m_SocketDescriptor; }
};

void number(igt::Bytes& out, std::uint64_t value, int size) {
  for (int i = size - 1; i >= 0; --i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

}  // namespace

LibraryClient::LibraryClient(std::uint16_t port) {
  connected_ = socket_->ConnectToServer("127.0.0.1", port) == 0;
  socket_->SetReceiveTimeout(2000);
}

std::optional<Got> LibraryClient::next(int wait_ms) {
  if (!connected_ || !socket_->GetConnected()) return std::nullopt;
  pollfd p{(*socket_).*Reach::descriptor(), POLLIN, 0};
  if (poll(&p, 1, wait_ms) <= 0) return std::nullopt;
  igtl::MessageHeader::Pointer header = igtl::MessageHeader::New();
  header->InitPack();
  if (socket_->Receive(header->GetPackPointer(), header->GetPackSize()) != header->GetPackSize())
    return std::nullopt;
  Got got;
  got.header_version = static_cast<const std::uint8_t*>(header->GetPackPointer())[1];
  header->Unpack();
  igtl::TimeStamp::Pointer stamp = igtl::TimeStamp::New();
  header->GetTimeStamp(stamp);
  got.type = header->GetDeviceType();
  got.device = header->GetDeviceName();
  got.utc_ns = static_cast<std::int64_t>(stamp->GetTimeStampInNanoseconds());
  if (got.type == "TRANSFORM")
    takeTransform(*socket_, *header, got);
  else if (got.type == "TDATA")
    takeTracking(*socket_, *header, got);
  else if (got.type == "SENSOR")
    takeSensor(*socket_, *header, got);
  else
    takeRest(*socket_, *header, got);
  return got;
}

std::vector<Got> LibraryClient::all() {
  std::vector<Got> messages;
  while (auto got = next(50)) messages.push_back(std::move(*got));
  return messages;
}

void LibraryClient::ask(igtl::MessageBase& message) {
  message.SetDeviceName("Tester");
  message.Pack();
  socket_->Send(message.GetPackPointer(), message.GetPackSize());
}

void LibraryClient::startTracking(int resolution_ms, const std::string& coordinates) {
  igtl::StartTrackingDataMessage::Pointer message = igtl::StartTrackingDataMessage::New();
  message->SetResolution(resolution_ms);
  message->SetCoordinateName(coordinates.c_str());
  ask(*message);
}

void LibraryClient::stopTracking() {
  igtl::StopTrackingDataMessage::Pointer message = igtl::StopTrackingDataMessage::New();
  ask(*message);
}

std::optional<Got> lastOf(const std::vector<Got>& messages, const std::string& device) {
  for (auto m = messages.rbegin(); m != messages.rend(); ++m)
    if (m->device == device) return *m;
  return std::nullopt;
}

int countOf(const std::vector<Got>& messages, const std::string& type) {
  int count = 0;
  for (const Got& m : messages) count += m.type == type;
  return count;
}

LibraryServer::LibraryServer(int port) {
  if (server_->CreateServer(port) == 0) port_ = server_->GetServerPort();
}

bool LibraryServer::accept(int wait_ms) {
  peer_ = server_->WaitForConnection(static_cast<unsigned long>(wait_ms));
  return peer_.IsNotNull();
}

void LibraryServer::hangUp() {
  if (peer_.IsNotNull()) peer_->CloseSocket();
}

void LibraryServer::stop() {
  hangUp();
  server_->CloseSocket();
}

igt::Bytes headerOf(const std::string& type, std::uint64_t body_size) {
  igt::Bytes bytes = igt::transformMessage("X", Mat4::Identity(), 0);
  for (std::size_t i = 0; i < 12; ++i)
    bytes[2 + i] = i < type.size() ? static_cast<std::uint8_t>(type[i]) : 0;
  bytes.resize(42);
  number(bytes, body_size, 8);
  number(bytes, 0, 8);
  return bytes;
}

igt::Bytes withChecksum(igt::Bytes message) {
  const std::uint64_t crc =
      crc64(message.data() + igt::kHeaderSize, message.size() - igt::kHeaderSize, 0);
  for (std::size_t i = 0; i < 8; ++i)
    message[50 + i] = static_cast<std::uint8_t>(crc >> (8 * (7 - i)));
  return message;
}

igt::Bytes withMetadata(const igt::Bytes& version1,
                        const std::vector<std::pair<std::string, std::string>>& metadata) {
  igt::Bytes body, entries, texts;
  number(entries, metadata.size(), 2);
  for (const auto& [key, value] : metadata) {
    number(entries, key.size(), 2);
    number(entries, 3, 2);  // US-ASCII
    number(entries, value.size(), 4);
    texts.insert(texts.end(), key.begin(), key.end());
    texts.insert(texts.end(), value.begin(), value.end());
  }
  number(body, 12, 2);
  number(body, entries.size(), 2);
  number(body, texts.size(), 4);
  number(body, 7, 4);
  body.insert(body.end(), version1.begin() + igt::kHeaderSize, version1.end());
  body.insert(body.end(), entries.begin(), entries.end());
  body.insert(body.end(), texts.begin(), texts.end());
  igt::Bytes message(version1.begin(), version1.begin() + 42);
  message[1] = 2;
  number(message, body.size(), 8);
  number(message, crc64(body.data(), body.size(), 0), 8);
  message.insert(message.end(), body.begin(), body.end());
  return message;
}

}  // namespace palpa::igt_test
