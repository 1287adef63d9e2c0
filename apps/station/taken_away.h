#pragma once

#include <string>
#include <vector>

#include "apps/station/material_files.h"
#include "apps/station/station_file.h"
#include "apps/station/task_sections.h"
#include "haptics/safety/passive_law.h"

/// What a station can take away from what is real, known before a session starts: a lump or a
/// surface's friction that its device has to pull against, a hand's tremor.
namespace palpa::station {

/// How late the loop answers a force that is sensed: its period, and what the filter of the force
/// sensor takes (a call and sqrt(2)/(2 pi f_c) of a low-pass; a call where the reaction is
/// predicted).
haptics::LoopDelay sensedDelay(const Station& station, double rate_Hz);
/// How late it answers a motion.
inline haptics::LoopDelay motionDelay(double rate_Hz) { return {1 / rate_Hz, 0}; }

/// A spring that is taken away, N/m, and how stiff it may be on this device, however it is held.
struct TakenLimit {
  double taken = 0, largest = 0;
  double delay_s = 0;  ///< of the force that is sensed, device and loop included
  double share() const { return taken > largest ? largest / taken : 1; }
};
/// Of a lump of the library under a surface that is pressed with `hardest` N at most.
TakenLimit takenLimit(const Station& station, const LumpLibrary& library, std::size_t kind,
                      double hardest, double rate_Hz);
/// Of a surface whose friction is taken off and another put in its place: what gives way before it
/// slides.
TakenLimit takenLimit(const Station& station, const haptics::Dahl& friction, double rate_Hz);
/// "up to 69 N/m are taken, 4400 N/m would be passive with a grip of 2 N s/m", ...
std::string inWords(const TakenLimit& limit);

/// A steadying of a task on a device.
struct SteadyingFigures {
  std::string name;
  haptics::DampedBand band;
  double asked = 0, largest = 0;  ///< N s/m
  double delay_s = 0;             ///< in the middle of the band
  double settling_s = 0;
};
std::vector<SteadyingFigures> steadyingsOf(const NamedPlan& named, const Station& station,
                                           double rate_Hz);
std::string inWords(const SteadyingFigures& figures);

}  // namespace palpa::station
