#include "apps/twin/phantom/rough_surface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/random.h"

namespace palpa::twin {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kGrain = 10e-6;               // m between the profile's points
constexpr double kFine = 5e-5, kWarmUp = 0.4;  // s: step; before the recording begins
constexpr std::size_t kPerSample = 20;         // steps
constexpr double kCapHalf = 0.3e-3;            // m of the tip to each side that can touch
constexpr std::size_t kTaps = 1501;
constexpr double kCutOff = 490.0 * kFine;  // of the fine rate
constexpr double kLeastHold = 0.1;         // of the elastic force, where the tip leaves fast
constexpr double kShortestRib = 0.3;       // of the period
constexpr int kSettle = 5000;              // points

using Series = std::vector<double>;

void addRoughness(const RoughSurface& surface, RandomStream& random, Series* z) {
  const double keeps = std::exp(-kTurn * surface.corner * kGrain),
               keeps_fine = std::exp(-8 * kTurn * surface.corner * kGrain);
  Series rough;
  double coarse = 0, fine = 0, squares = 0;
  for (int i = 0; i < kSettle; ++i) coarse = keeps * coarse + random.normal();
  for (std::size_t i = 0; i < z->size(); ++i) {
    coarse = keeps * coarse + random.normal();
    fine = keeps_fine * fine + (1 - keeps_fine) * coarse;
    rough.push_back(fine);
    squares += fine * fine;
  }
  const double scale = surface.rms / std::sqrt(squares / static_cast<double>(z->size()));
  for (std::size_t i = 0; i < z->size(); ++i) (*z)[i] += scale * rough[i];
}

void addRibs(const RoughSurface& surface, RandomStream& random, Series* z) {
  if (surface.rib_period <= 0) return;
  double begin = 0;
  for (std::size_t i = 0; i < z->size();) {
    const double length = surface.rib_period *
                          std::max(kShortestRib, random.normal(1, surface.rib_spread)),
                 height = surface.rib_height * random.normal(1, surface.rib_spread);
    for (; i < z->size() && static_cast<double>(i) * kGrain < begin + length; ++i) {
      const double u = (static_cast<double>(i) * kGrain - begin) / length;
      (*z)[i] += 0.5 * height * (1 - std::cos(kTurn * u));
    }
    begin += length;
  }
}

/// Where the lowest point of a circle that rolls over the profile goes.
Series envelopeOf(const Series& z, double radius) {
  const auto half = static_cast<std::ptrdiff_t>(std::min(radius, kCapHalf) / kGrain);
  Series cap;
  for (std::ptrdiff_t k = -half; k <= half; ++k) {
    const double u = static_cast<double>(k) * kGrain;
    cap.push_back(std::sqrt(std::max(radius * radius - u * u, 0.0)) - radius);
  }
  const auto size = static_cast<std::ptrdiff_t>(z.size());
  Series envelope;
  for (std::ptrdiff_t i = 0; i < size; ++i) {
    double highest = -1;
    for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(-half, -i); k <= half && i + k < size; ++k)
      highest = std::max(
          highest, z[static_cast<std::size_t>(i + k)] + cap[static_cast<std::size_t>(k + half)]);
    envelope.push_back(highest);
  }
  return envelope;
}

/// A windowed sinc (Blackman), from the fine rate to the recording's.
Series antiAlias() {
  Series h;
  double sum = 0;
  const double last = static_cast<double>(kTaps - 1);
  for (std::size_t i = 0; i < kTaps; ++i) {
    const double n = static_cast<double>(i), x = std::numbers::pi * (n - last / 2),
                 sinc = x == 0 ? 2 * kCutOff : std::sin(2 * kCutOff * x) / x,
                 window = 0.42 - 0.5 * std::cos(kTurn * n / last) +
                          0.08 * std::cos(2 * kTurn * n / last);
    h.push_back(sinc * window);
    sum += h.back();
  }
  for (double& tap : h) tap /= sum;
  return h;
}

/// The hand's force and speed over time.
class StrayingHand {
 public:
  StrayingHand(const RoughStroke& stroke, RandomStream& random)
      : stroke_(stroke), phase_f_(random.uniform(0, kTurn)), phase_v_(random.uniform(0, kTurn)) {}
  double force(double t) const {  // 1.1 and 0.7 Hz: as slowly as hands stray [chosen]
    return stroke_.force * (1 + stroke_.stray * std::sin(kTurn * 1.1 * t + phase_f_));
  }
  double speed(double t) const {
    return stroke_.speed * (1 + stroke_.stray * std::sin(kTurn * 0.7 * t + phase_v_));
  }

 private:
  const RoughStroke& stroke_;
  double phase_f_, phase_v_;
};

/// The tip's acceleration at the fine rate.
Series ride(const RoughSurface& surface, const RoughTool& tool, const StrayingHand& hand,
            const Series& z, double seconds) {
  const auto steps = static_cast<std::size_t>((seconds + kWarmUp) / kFine);
  Series acceleration;
  double s = 0.5e-3, way_before = s, y = 0, v = 0, z_before = 0;
  const auto heightAt = [&](double way) {
    const double q = way / kGrain;
    const auto k = std::min(static_cast<std::size_t>(q), z.size() - 2);
    return z[k] + (q - static_cast<double>(k)) * (z[k + 1] - z[k]);
  };
  z_before = heightAt(way_before);
  y = z_before - std::pow(hand.force(0) / surface.stiffness, 2.0 / 3);
  for (std::size_t i = 0; i < steps; ++i) {
    const double t = static_cast<double>(i) * kFine;
    s += hand.speed(t) * kFine;
    const double height = heightAt(s), d = height - y, rate = (height - z_before) / kFine - v;
    z_before = height;
    const double f_c =
        d > 0 ? surface.stiffness * d * std::sqrt(d) * std::max(kLeastHold, 1 + surface.loss * rate)
              : 0;
    acceleration.push_back((f_c - hand.force(t) - tool.damping * v) / tool.mass);
    v += acceleration.back() * kFine;
    y += v * kFine;
  }
  return acceleration;
}

RoughSurface surfaceOf(const JsonFile& entry) {
  RoughSurface surface;
  surface.name = entry.text("name");
  surface.rms = 1e-6 * entry.number("rms_um", 0, 200);
  surface.corner = 1e3 * entry.number("corner_per_mm", 0.05, 20);
  surface.rib_period = 1e-3 * entry.number("rib_period_mm", 0, 20);
  surface.rib_height = 1e-6 * entry.number("rib_height_um", 0, 500);
  surface.rib_spread = entry.number("rib_spread", 0, 0.5);
  surface.stiffness = 1e6 * entry.number("stiffness_MN_per_m15", 0.1, 1000);
  surface.loss = entry.number("loss_s_per_m", 0, 100);
  return surface;
}

}  // namespace

RoughBench readRoughBench(const std::filesystem::path& path) {
  const JsonFile file(path);
  needKind(file, "rough_surfaces", 1);
  RoughBench bench;
  bench.tool.radius = 1e-3 * file.number("tip_radius_mm", 0.1, 10);
  bench.tool.mass = 1e-3 * file.number("tool_mass_g", 5, 500);
  bench.tool.damping = file.number("grip_damping_Ns_per_m", 0, 50);
  bench.tool.noise_m_s2 = file.number("noise_m_per_s2", 0, 1);
  for (const JsonFile& entry : file.entries("surfaces")) bench.surfaces.push_back(surfaceOf(entry));
  if (bench.surfaces.empty()) file.refuse("surfaces", "must hold a surface");
  return bench;
}

RoughRecording strokeRough(const RoughSurface& surface, const RoughTool& tool,
                           const RoughStroke& stroke) {
  RandomStream random(stroke.seed, "rough_surface");
  const double longest = stroke.speed * (1 + stroke.stray) * (stroke.seconds + kWarmUp);
  Series z(static_cast<std::size_t>((longest + 2e-3) / kGrain));
  addRoughness(surface, random, &z);
  addRibs(surface, random, &z);
  const StrayingHand hand(stroke, random);
  const Series fine = ride(surface, tool, hand, envelopeOf(z, tool.radius), stroke.seconds),
               h = antiAlias();
  RoughRecording recording;
  const auto samples = static_cast<std::size_t>(stroke.seconds / recording.dt);
  const auto warm = static_cast<std::size_t>(kWarmUp / kFine);
  for (std::size_t i = 0; i < samples; ++i) {
    const std::size_t end = warm + i * kPerSample;
    double sum = 0;
    for (std::size_t k = 0; k < kTaps; ++k) sum += h[k] * fine[end - k];
    const double t = (static_cast<double>(end) - static_cast<double>(kTaps / 2)) * kFine;
    recording.acceleration.push_back(sum + random.normal(0, tool.noise_m_s2));
    recording.f_n.push_back(hand.force(t));
    recording.speed.push_back(hand.speed(t));
  }
  return recording;
}

}  // namespace palpa::twin
