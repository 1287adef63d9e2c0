#include "apps/bench/texture_study.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "apps/station/assets.h"
#include "apps/station/material_files.h"
#include "apps/twin/device_twin.h"
#include "haptics/loop/tick.h"

namespace palpa::bench {
namespace {

constexpr double kTexturedTick = 1e-3, kCircle = 0.04;  // s; m, radius: a stroke without an end
constexpr std::size_t kTexturedWarmUp = 500;            // ticks

std::string fileOf(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '-');
  return "materials/textures/" + name + ".json";
}

/// A real object that is left as it is, but for the texture.
haptics::TickConfig texturedTick(const haptics::TextureLaw& law) {
  haptics::TickConfig config;
  config.contact_mode = haptics::ContactMode::sensed_object;
  config.object_at_port = 1;
  config.passivity.max_damping = 9;  // 0.2 m / T of 45 g at 1 kHz
  config.passivity.coulomb = 0.06;
  config.touch.surface.contact.real = {500, 5, 1.3};
  config.touch.texture = law;
  return config;
}

/// The stroke's hand, tool and device, from tick to tick.
class TexturedHand {
 public:
  TexturedHand(const haptics::TextureLaw& law, const twin::RoughRecording& recording)
      : config_(texturedTick(law)),
        state_(std::make_unique<haptics::TickState>()),
        recording_(recording),
        device_({}, makePose(Mat3::Identity(), Vec3(kCircle, 0, 0))) {
    commands_.armed = 1;
  }
  haptics::FlightRecord tick(std::size_t i) {
    const std::size_t now = i % recording_.f_n.size();
    angle_ += recording_.speed[now] * kTexturedTick / kCircle;
    const Vec3 p(kCircle * std::cos(angle_), kCircle * std::sin(angle_), 0);
    haptics::DeviceReading reading;
    reading.t_ns = 1'000'000 * static_cast<std::int64_t>(i + 1);
    reading.sequence = i + 1;
    reading.homed = 1;
    reading.p_DE = pack(p);
    haptics::SensedForce sensed;
    sensed.state = haptics::SensorState::valid;
    sensed.f_D = pack(Vec3(0, 0, recording_.f_n[now]));
    sensed.p_DK = pack(p);
    const haptics::FlightRecord record =
        haptics::tick(config_, *state_, reading, nullptr, commands_, reading.t_ns, sensed);
    device_.advance(kTexturedTick, makePose(Mat3::Identity(), p), {}, unpack(record.f_command_D));
    return record;
  }
  double fingers() const { return device_.meanFingerForce().z(); }

 private:
  haptics::TickConfig config_;
  std::unique_ptr<haptics::TickState> state_;
  haptics::TickCommands commands_;
  const twin::RoughRecording& recording_;
  twin::DeviceTwin device_;
  double angle_ = 0;
};

std::vector<double> shakingOf(const twin::RoughRecording& recording, double mass) {
  std::vector<double> shaking;
  for (const double a : recording.acceleration) shaking.push_back(mass * a);
  return shaking;
}

}  // namespace

std::vector<ShippedTexture> shippedTextures(const twin::RoughBench& rough) {
  std::vector<ShippedTexture> all;
  for (const twin::RoughSurface& surface : rough.surfaces)
    all.push_back(
        {surface, station::bounded(station::readTexture(station::assetFile(fileOf(surface.name))),
                                   haptics::SafetyLimits{}.max_slew_N_per_s, 1 / kTexturedTick)});
  return all;
}

TextureFigures textureFigures(const ShippedTexture& texture, const twin::RoughTool& tool,
                              const twin::RoughStroke& stroke) {
  const twin::RoughRecording recording = twin::strokeRough(texture.surface, tool, stroke);
  TexturedHand hand(texture.law, recording);
  for (std::size_t i = 0; i < kTexturedWarmUp; ++i) hand.tick(i);
  std::vector<double> commanded, felt;
  TextureFigures figures;
  for (std::size_t i = 0; i < recording.f_n.size(); ++i) {
    const haptics::FlightRecord record = hand.tick(kTexturedWarmUp + i);
    commanded.push_back(unpack(record.f_command_D).z());
    felt.push_back(hand.fingers());
    figures.largest_N = std::max(figures.largest_N, std::abs(commanded.back()));
    figures.limited += record.safety != haptics::SafetyCause::none;
  }
  figures.limited /= static_cast<double>(recording.f_n.size());
  const double rate = 1 / kTexturedTick;
  const auto recorded = calibration::thirdOctavePowers(shakingOf(recording, tool.mass), rate);
  figures.commanded_dB =
      calibration::levelDifference(calibration::thirdOctavePowers(commanded, rate), recorded);
  figures.hand_dB =
      calibration::levelDifference(calibration::thirdOctavePowers(felt, rate), recorded);
  return figures;
}

double worstOf(const std::array<double, calibration::kThirdOctaves>& levels_dB) {
  return *std::max_element(levels_dB.begin(), levels_dB.end(),
                           [](double a, double b) { return std::abs(a) < std::abs(b); });
}

}  // namespace palpa::bench
