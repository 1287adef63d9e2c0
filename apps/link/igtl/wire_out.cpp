#include <igtlSensorMessage.h>
#include <igtlStatusMessage.h>
#include <igtlStringMessage.h>
#include <igtlTrackingDataMessage.h>
#include <igtlTransformMessage.h>

#include <algorithm>

#include "apps/link/igtl/wire.h"

namespace palpa::igt {
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
