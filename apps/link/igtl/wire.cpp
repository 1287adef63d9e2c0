#include "apps/link/igtl/wire.h"

#include <igtlSensorMessage.h>
#include <igtlStatusMessage.h>
#include <igtlStringMessage.h>
#include <igtlTrackingDataMessage.h>
#include <igtlTransformMessage.h>
#include <igtl_header.h>
#include <igtl_tdata.h>
#include <igtl_transform.h>
#include <igtl_util.h>

#include <algorithm>
#include <cctype>
#include <cstring>

/// Sizes are checked here before anything is taken: the library's own unpacking believes what it is
/// told.
namespace palpa::igt {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::size_t kExtendedHeader = 12, kEntry = 8, kCount = 2;

/// Big endian, of `size` bytes at `at`; they are there.
std::uint64_t number(View bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (const std::uint8_t byte : bytes.subspan(at, size)) value = value << 8 | byte;
  return value;
}

/// Of a field that ends at its first 0, or at its end.
std::string textOf(const char* field, std::size_t size) {
  return std::string(field, strnlen(field, size));
}

/// Columns t, s, n, position, as floats.
Mat4 matrixOf(const float (&columns)[12]) {
  Mat4 X_mm = Mat4::Identity();
  for (int i = 0; i < 12; ++i) X_mm(i % 3, i / 3) = columns[i];
  return X_mm;
}

/// Two bytes of count; key size, encoding, value size for each; then key, value, key, value.
std::optional<std::map<std::string, std::string>> metadataOf(View header, View body) {
  std::map<std::string, std::string> metadata;
  if (header.size() < kCount) return metadata;
  const std::size_t count = number(header, 0, kCount);
  if (header.size() < kCount + count * kEntry) return std::nullopt;
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t key = number(header, kCount + i * kEntry, 2),
                      value = number(header, kCount + i * kEntry + 4, 4);
    if (key > body.size() - at || value > body.size() - at - key) return std::nullopt;
    const auto* text = reinterpret_cast<const char*>(body.data());
    metadata[std::string(text + at, key)] = std::string(text + at + key, value);
    at += key + value;
  }
  return metadata;
}

}  // namespace

std::optional<Header> readHeader(std::span<const std::uint8_t, kHeaderSize> bytes) {
  igtl_header raw;
  static_assert(sizeof raw == kHeaderSize);
  std::memcpy(&raw, bytes.data(), sizeof raw);
  igtl_header_convert_byte_order(&raw);
  Header header;
  header.version = raw.version;
  header.type = textOf(raw.name, IGTL_HEADER_TYPE_SIZE);
  header.device = textOf(raw.device_name, IGTL_HEADER_NAME_SIZE);
  const bool printable = std::all_of(header.type.begin(), header.type.end(),
                                     [](unsigned char c) { return std::isprint(c); });
  if (header.version < 1 || header.version > kNewestLikely || header.type.empty() || !printable)
    return std::nullopt;
  const auto fraction = static_cast<std::uint32_t>(raw.timestamp & 0xffffffffu);
  header.utc_ns =
      static_cast<std::int64_t>(raw.timestamp >> 32) * kSecond + igtl_frac_to_nanosec(fraction);
  header.body_size = raw.body_size;
  header.crc = raw.crc;
  return header;
}

bool crcFits(const Header& header, View body) {
  Bytes copy(body.begin(), body.end());  // the library takes no constant
  return crc64(copy.data(), copy.size(), crc64(nullptr, 0, 0)) == header.crc;
}

std::optional<Content> contentOf(const Header& header, View body) {
  if (header.version == 1) return Content{body, {}};
  if (body.size() < kExtendedHeader) return std::nullopt;
  const std::size_t extended = number(body, 0, 2), entries = number(body, 2, 2),
                    metadata = number(body, 4, 4);
  if (extended < kExtendedHeader || extended + entries + metadata > body.size())
    return std::nullopt;
  const std::size_t end = body.size() - entries - metadata;
  auto data = metadataOf(body.subspan(end, entries), body.subspan(end + entries));
  if (!data) return std::nullopt;
  return Content{body.subspan(extended, end - extended), std::move(*data)};
}

std::optional<Mat4> readTransform(View content) {
  if (content.size() != IGTL_TRANSFORM_SIZE) return std::nullopt;
  float columns[12];
  std::memcpy(columns, content.data(), sizeof columns);
  igtl_transform_convert_byte_order(columns);
  return matrixOf(columns);
}

std::optional<std::vector<NamedMatrix>> readTracking(View content) {
  if (content.size() % IGTL_TDATA_ELEMENT_SIZE != 0) return std::nullopt;
  std::vector<NamedMatrix> tools;
  for (std::size_t at = 0; at < content.size(); at += IGTL_TDATA_ELEMENT_SIZE) {
    igtl_tdata_element element;
    static_assert(sizeof element == IGTL_TDATA_ELEMENT_SIZE);
    std::memcpy(&element, content.data() + at, sizeof element);
    igtl_tdata_convert_byte_order(&element, 1);
    float columns[12];
    std::memcpy(columns, element.transform,
                sizeof columns);  // the element is packed: its floats lie anywhere
    tools.push_back({textOf(element.name, IGTL_TDATA_LEN_NAME), matrixOf(columns)});
  }
  return tools;
}

std::optional<TrackingRequest> readTrackingRequest(View content) {
  igtl_stt_tdata raw;
  static_assert(sizeof raw == IGTL_STT_TDATA_SIZE);
  if (content.size() != sizeof raw) return std::nullopt;
  std::memcpy(&raw, content.data(), sizeof raw);
  igtl_stt_tdata_convert_byte_order(&raw);
  return TrackingRequest{raw.resolution, textOf(raw.coord_name, IGTL_STT_TDATA_LEN_COORDNAME)};
}

namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr int kUtf8 = 106;  // its number in IANA's list of character sets

std::string cut(const std::string& name) { return name.substr(0, kLongestName); }

/// The message counts its bytes with 16 bits; no character is cut in two.
std::string shortened(const std::string& utf8) {
  std::size_t end = std::min<std::size_t>(utf8.size(), 0xffff);
  while (end < utf8.size() && end > 0 && (static_cast<unsigned char>(utf8[end]) & 0xc0) == 0x80)
    --end;
  return utf8.substr(0, end);
}

Bytes packed(igtl::MessageBase& message, const std::string& device, std::int64_t utc_ns) {
  igtl::TimeStamp::Pointer stamp = igtl::TimeStamp::New();
  stamp->SetTime(static_cast<igtlUint32>(utc_ns / kSecond_ns),
                 static_cast<igtlUint32>(utc_ns % kSecond_ns));
  message.SetTimeStamp(stamp);
  message.SetDeviceName(cut(device).c_str());
  message.Pack();
  const auto* first = static_cast<const std::uint8_t*>(message.GetPackPointer());
  return Bytes(first, first + message.GetPackSize());
}

void copy(const Mat4& X_mm, igtl::Matrix4x4& matrix) {
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      matrix[row][column] = static_cast<float>(X_mm(row, column));
}

igtl::igtlUnit unitOf(Quantity quantity) {
  igtl::Unit::Pointer unit = igtl::Unit::New();
  unit->SetPrefix(quantity == Quantity::millimetres ? igtl::Unit::SI_PREFIX_MILLI
                                                    : igtl::Unit::SI_PREFIX_NONE);
  unit->Append(
      quantity == Quantity::millimetres ? igtl::Unit::SI_BASE_METER : igtl::Unit::SI_DERIVED_NEWTON,
      1);
  return unit->Pack();
}

}  // namespace

Bytes transformMessage(const std::string& device, const Mat4& X_mm, std::int64_t utc_ns) {
  igtl::TransformMessage::Pointer message = igtl::TransformMessage::New();
  igtl::Matrix4x4 matrix;
  copy(X_mm, matrix);
  message->SetMatrix(matrix);
  return packed(*message, device, utc_ns);
}

Bytes trackingMessage(const std::string& device, const std::vector<NamedMatrix>& tools,
                      std::int64_t utc_ns) {
  igtl::TrackingDataMessage::Pointer message = igtl::TrackingDataMessage::New();
  for (const NamedMatrix& tool : tools) {
    igtl::TrackingDataElement::Pointer element = igtl::TrackingDataElement::New();
    igtl::Matrix4x4 matrix;
    copy(tool.X_mm, matrix);
    element->SetName(cut(tool.name).c_str());
    element->SetType(igtl::TrackingDataElement::TYPE_6D);
    element->SetMatrix(matrix);
    message->AddTrackingDataElement(element);
  }
  return packed(*message, device, utc_ns);
}

Bytes sensorMessage(const std::string& device, std::vector<double> values, Quantity quantity,
                    std::int64_t utc_ns) {
  igtl::SensorMessage::Pointer message = igtl::SensorMessage::New();
  message->SetLength(static_cast<unsigned int>(values.size()));
  message->SetUnit(unitOf(quantity));
  message->SetValue(values.data());
  return packed(*message, device, utc_ns);
}

Bytes stringMessage(const std::string& device, const std::string& utf8, std::int64_t utc_ns) {
  igtl::StringMessage::Pointer message = igtl::StringMessage::New();
  message->SetEncoding(kUtf8);
  message->SetString(shortened(utf8).c_str());
  return packed(*message, device, utc_ns);
}

Bytes statusMessage(const std::string& device, const std::string& text, std::int64_t utc_ns) {
  igtl::StatusMessage::Pointer message = igtl::StatusMessage::New();
  message->SetCode(igtl::StatusMessage::STATUS_OK);
  message->SetErrorName("");
  message->SetStatusString(text.c_str());
  return packed(*message, device, utc_ns);
}

Bytes trackingAnswer(const std::string& device, bool granted, std::int64_t utc_ns) {
  igtl::RTSTrackingDataMessage::Pointer message = igtl::RTSTrackingDataMessage::New();
  message->SetStatus(granted ? igtl::RTSTrackingDataMessage::STATUS_SUCCESS
                             : igtl::RTSTrackingDataMessage::STATUS_ERROR);
  return packed(*message, device, utc_ns);
}

Bytes startTrackingMessage(const std::string& device, const TrackingRequest& request,
                           std::int64_t utc_ns) {
  igtl::StartTrackingDataMessage::Pointer message = igtl::StartTrackingDataMessage::New();
  message->SetResolution(request.resolution_ms);
  message->SetCoordinateName(request.coordinates.c_str());
  return packed(*message, device, utc_ns);
}

Bytes stopTrackingMessage(const std::string& device, std::int64_t utc_ns) {
  igtl::StopTrackingDataMessage::Pointer message = igtl::StopTrackingDataMessage::New();
  return packed(*message, device, utc_ns);
}

}  // namespace palpa::igt
