#include "apps/station/taken_away.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "haptics/modulation/taken_lumps.h"

namespace palpa::station {
namespace {

template <typename... Figures>
std::string written(const char* pattern, Figures... figures) {
  char text[255];
  std::snprintf(text, sizeof text, pattern, figures...);
  return text;
}

TakenLimit limitOf(const Station& station, double taken, double rate_Hz) {
  const haptics::LoopDelay delay = sensedDelay(station, rate_Hz);
  const haptics::DeviceCapabilities& device = station.device.capabilities;
  return {taken, haptics::largestTaken(device, delay),
          delay.period_s / 2 + delay.beyond_s + device.delay};
}

}  // namespace

haptics::LoopDelay sensedDelay(const Station& station, double rate_Hz) {
  haptics::LoopDelay delay{1 / rate_Hz, 1 / rate_Hz};
  if (station.force_sensor && !station.force_sensor->noise_N)
    delay.beyond_s +=
        std::numbers::sqrt2 / (2 * std::numbers::pi * station.force_sensor->cutoff_Hz);
  return delay;
}

/// As deep as the surface alone would be: with the lump below it is less.
TakenLimit takenLimit(const Station& station, const LumpLibrary& library, std::size_t kind,
                      double hardest, double rate_Hz) {
  const double deepest = library.x0 + haptics::depthOf(library.surface, hardest, 0);
  return limitOf(station,
                 haptics::steepestRise(library.kinds[kind].law, library.tip_radius, deepest),
                 rate_Hz);
}

TakenLimit takenLimit(const Station& station, const haptics::Dahl& friction, double rate_Hz) {
  return limitOf(station, friction.sigma, rate_Hz);
}

std::string inWords(const TakenLimit& limit) {
  std::string words = written(
      "%.0f N/m are taken at most; %.0f N/m would be passive, %.1f ms late, in the lightest "
      "grip (%.0f N s/m)",
      limit.taken, limit.largest, 1e3 * limit.delay_s, haptics::kLightestGrip);
  if (limit.share() < 1) words += written("; so %.0f %% of it is taken", 100 * limit.share());
  return words;
}

std::vector<SteadyingFigures> steadyingsOf(const NamedPlan& named, const Station& station,
                                           double rate_Hz) {
  std::vector<SteadyingFigures> all;
  for (std::size_t i = 0; i < named.augmentations.size(); ++i) {
    const haptics::Augmentation& a = named.plan.each[i];
    if (a.kind != haptics::AugmentationKind::steadying) continue;
    const haptics::LoopDelay delay = motionDelay(rate_Hz);
    SteadyingFigures one{named.augmentations[i].name, {a.from_Hz, a.to_Hz, a.amplitude}};
    one.asked = a.amplitude;
    one.largest = haptics::largestBandDamping(one.band, station.device.capabilities, delay);
    one.band.damping = std::min(one.asked, one.largest);
    const double middle = one.band.omega() / (2 * std::numbers::pi);
    one.delay_s =
        haptics::bandDelay(one.band, {delay.period_s, station.device.capabilities.delay}, middle);
    one.settling_s = haptics::bandSettling(one.band);
    all.push_back(one);
  }
  return all;
}

std::string inWords(const SteadyingFigures& figures) {
  return written(
      "%.0f to %.0f Hz, %.0f N s/m of at most %.0f that are passive; %.1f ms late, takes "
      "hold within %.0f ms",
      figures.band.from_Hz, figures.band.to_Hz, figures.band.damping, figures.largest,
      1e3 * figures.delay_s, 1e3 * figures.settling_s);
}

}  // namespace palpa::station
