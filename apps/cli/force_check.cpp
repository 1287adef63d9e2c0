#include "apps/cli/force_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/station/json_file.h"

namespace palpa::cli {
namespace {

/// The parts of a session one after the other: their figures together.
class Together {
 public:
  void add(const assess::ForceBalance& part) {
    if (part.samples == 0) return;
    sum2_ += part.rms_N * part.rms_N * static_cast<double>(part.samples);
    all_.samples += part.samples;
    all_.largest_N = std::max(all_.largest_N, part.largest_N);
    all_.object_N = std::max(all_.object_N, part.object_N);
    all_.delay_s = part.delay_s;
    all_.rms_N = std::sqrt(sum2_ / static_cast<double>(all_.samples));
  }
  const assess::ForceBalance& all() const { return all_; }

 private:
  assess::ForceBalance all_;
  double sum2_ = 0;
};

}  // namespace

std::optional<assess::ForceBalance> recordedBalance(const record::SessionReader& reader) {
  constexpr std::size_t kPart = 200'000;  // ticks: what is held in memory at once
  const double mass =
      station::JsonFile(nlohmann::json::parse(reader.info().station_json), "the recorded station")
          .number("device/apparent_mass_kg", 0, 5);
  Together together;
  std::array<std::vector<haptics::FlightRecord>, 2> parts;  // of each tool
  const auto finish = [&] {
    for (std::vector<haptics::FlightRecord>& part : parts) {
      together.add(assess::balanceOf(part, mass));
      part.clear();
    }
  };
  reader.ticks([&](const haptics::FlightRecord& tick) {
    if (tick.reading.instrumented && tick.sensed.state == haptics::SensorState::valid)
      parts[tick.tool & 1].push_back(tick);
    if (parts[0].size() >= kPart) finish();
  });
  finish();
  if (together.all().samples == 0) return std::nullopt;
  return together.all();
}

}  // namespace palpa::cli
