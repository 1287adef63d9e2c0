#include "haptics/sensors/net_ft_sensor.h"

#include <cerrno>
#include <span>
#include <utility>

namespace palpa::haptics {
namespace {

std::string placeOf(const NetFtSettings& settings) {
  return "force sensor " + settings.address + ":" + std::to_string(settings.port);
}

void requireUsable(const NetFtSettings& settings) {
  if (!(settings.scale.counts_per_N > 0) || !(settings.scale.counts_per_Nm > 0))
    throw UsageError("counts per N and per N m must be above 0", placeOf(settings),
                     "Take cfgcpf and cfgcpt from the sensor's page /netftapi2.xml.");
  if (settings.wait_ms < 1 || settings.answer_wait_ms < 1 || settings.answer_tries < 1)
    throw UsageError("waits and tries must be at least 1", placeOf(settings),
                     "Leave them out to have the usual ones.");
}

}  // namespace

NetFtSensor::NetFtSensor(NetFtSettings settings, Now now)
    : settings_((requireUsable(settings), std::move(settings))),
      now_(std::move(now)),
      where_(placeOf(settings_)),
      socket_(where_, settings_.address, settings_.port, settings_.local_port) {}

NetFtSensor::~NetFtSensor() {
  if (asked_) ask(kRdtStop);
}

void NetFtSensor::start() {
  int error = 0;
  for (int i = 0; i < settings_.answer_tries; ++i) {
    askForStream(now_());
    error = receive(settings_.answer_wait_ms);
    if (error == 0) return;
  }
  throw networkError(error, where_);
}

void NetFtSensor::step() noexcept {
  if (bias_wanted_.exchange(false, std::memory_order_relaxed)) ask(kRdtSoftwareBias);
  receive(settings_.wait_ms);
  const std::int64_t now_ns = now_();
  if (now_ns - received_ns_ <= settings_.restart_ns) return;
  add(NetFtCount::restarts);
  askForStream(now_ns);
}

WrenchSample NetFtSensor::read(std::int64_t now_ns) noexcept {
  WrenchSample sample = latest_.read();
  if (sample.sequence == 0)
    sample.flags |= kNothingYet;
  else if (now_ns - sample.t_ns > settings_.silent_ns)
    sample.flags |= kSilent;
  return sample;
}

int NetFtSensor::ask(std::uint16_t command) noexcept {
  const int error = socket_.send(rdtRequest(command));
  if (error != 0) add(NetFtCount::errors);
  return error;
}

void NetFtSensor::askForStream(std::int64_t now_ns) noexcept {
  ask(settings_.start_code);
  asked_ = true;
  sequence_.known = false;
  received_ns_ = now_ns;
}

/// One datagram: 0 when it held something new, else the error number (EPROTO: no RDT).
int NetFtSensor::receive(int timeout_ms) noexcept {
  const UdpSocket::Received got = socket_.receive(datagram_, timeout_ms);
  if (got.error != 0) {
    if (got.error != EAGAIN) add(NetFtCount::errors);
    return got.error;
  }
  return take(got.bytes, now_()) ? 0 : EPROTO;
}

bool NetFtSensor::take(std::size_t datagram_bytes, std::int64_t now_ns) noexcept {
  const std::size_t records = rdtRecordCount(datagram_bytes);
  if (records == 0) add(NetFtCount::wrong_length);
  RdtRecord newest;
  bool any = false;
  for (std::size_t i = 0; i < records; ++i) {
    const auto bytes = std::span(datagram_).subspan(i * kRdtRecordBytes).first<kRdtRecordBytes>();
    const RdtRecord record = rdtRecord(bytes);
    if (!account(record)) continue;
    newest = record;
    any = true;
  }
  if (any) publish(newest, now_ns);
  return any;
}

bool NetFtSensor::account(const RdtRecord& record) noexcept {
  const RdtStep step = advance(sequence_, record);
  if (step.verdict == RdtVerdict::duplicate) add(NetFtCount::duplicates);
  if (step.verdict == RdtVerdict::late) add(NetFtCount::late);
  if (step.verdict != RdtVerdict::fresh) return false;
  add(NetFtCount::lost, step.missing);
  if (record.status != 0) add(NetFtCount::faults);
  add(NetFtCount::records);
  return true;
}

void NetFtSensor::publish(const RdtRecord& record, std::int64_t now_ns) noexcept {
  WrenchSample sample = rdtWrench(record, settings_.scale);
  sample.t_ns = now_ns;
  sample.sequence = count(NetFtCount::records);
  if (record.status & settings_.saturation_bits) sample.flags |= kSaturated;
  sample.flags |= overloadFlag(settings_.capabilities, sample);
  latest_.write(sample);
  received_ns_ = now_ns;
}

void NetFtSensor::add(NetFtCount what, std::uint64_t n) noexcept {
  counts_[static_cast<std::size_t>(what)].fetch_add(n, std::memory_order_release);
}

}  // namespace palpa::haptics
