#include "apps/doctor/station_check.h"

#include <cmath>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "apps/doctor/finding.h"
#include "apps/os/pedal.h"
#include "apps/record/store/store_look.h"
#include "apps/station/calibrations.h"

namespace palpa::doctor {
namespace {

constexpr const char* kAnew =
    "Calibrate it again, on the console's page Calibrate or by palpa calibrate all; until then "
    "sessions are not scored";

std::string waitingWords(std::size_t waiting) {
  if (waiting == 0) return "";
  return waiting == 1 ? "; one session waits to be delivered"
                      : "; " + std::to_string(waiting) + " sessions wait to be delivered";
}

/// Empty: nothing is wrong.
std::string faultIn(const station::Station& station, const station::AppliedCalibration& one,
                    const std::string& now_utc) {
  if (std::string fault = station::faultIn(one, station.calibrations, station.id); !fault.empty())
    return fault;
  if (one.file.date > now_utc)
    return "it was made on " + one.file.date.substr(0, 10) +
           ", which is still to come: the computer's date is wrong, or was";
  return station::outdatedOn({one}, now_utc);
}

}  // namespace

std::optional<station::Station> readStation(const std::filesystem::path& file, Findings* findings) {
  try {
    station::Station station = station::readStation(file);
    findings->push_back(
        {"station", State::well, station.title + (station.simulated ? " (simulated)" : "")});
    return station;
  } catch (const UsageError& e) {
    findings->push_back(troubled("station", State::ill, e.what()));
  } catch (const Error& e) {
    findings->push_back(troubled("station", State::ill, e.what()));
  }
  return std::nullopt;
}

Findings judgeCalibrations(const station::Station& station, const std::string& now_utc) {
  Findings findings;
  for (const station::AppliedCalibration& one : station.calibrations) {
    const std::string subject = nameOf(one.file.kind) + " calibration",
                      fault = faultIn(station, one, now_utc);
    if (fault.empty())
      findings.push_back({subject, State::well,
                          "of " + one.file.date.substr(0, 10) + ", good for " +
                              counted(one.file.valid_days, "day")});
    else
      findings.push_back({subject, State::note, fault, kAnew});
  }
  if (!findings.empty()) return findings;
  if (station.calibrated())
    return {{"calibrations", State::well,
             "as the station's file states them" +
                 (station.calibration_date.empty() ? "" : ": " + station.calibration_date)}};
  return {{"calibrations", State::note,
           station.calibration_verdict.empty() ? "missing" : station.calibration_verdict, kAnew}};
}

Finding askPedal(const station::Station& station) {
  constexpr const char* kPedal = "stop pedal";
  if (station.stop_pedal.empty())
    return {kPedal, State::absent, "none: the emergency stop is the space bar and the console"};
  try {
    const os::Pedal pedal(station.stop_pedal, os::Pedal::Use::look);
    return {kPedal, State::well,
            "is there, and has keys; press it in a session once, to be sure of it"};
  } catch (const Error& e) {
    return troubled(kPedal, State::ill, e.what());
  }
}

Finding judgePrint(const station::Station& station, double bar_mm) {
  constexpr double kRuler = 0.005,
                   kWrong =
                       0.02;  // what a ruler tells; from what on a registration by a tag is refused
  constexpr const char* kPrint = "board's print";
  const double off = bar_mm / 100 - 1;
  if (bar_mm > 0 && std::abs(off) > kRuler)
    return {kPrint, std::abs(off) > kWrong ? State::ill : State::note,
            text("is %.1f %% too %s: everything is drawn that much off its place",
                 100 * std::abs(off), off > 0 ? "large" : "small"),
            "Print it again at 100 % (\"actual size\", not \"fit to page\"): palpa board print; "
            "measure the bar of 100 mm"};
  if (bar_mm > 0) return {kPrint, State::well, text("its bar of 100 mm measures %.1f mm", bar_mm)};
  if (station.camera_setup.driver == station::CameraDriver::bench)
    return {kPrint, State::well, "simulated, in its true size"};
  const station::AppliedCalibration* registration =
      station::calibrationOf(station.calibrations, station::CalibrationKind::registration);
  if (registration && registration->file.passed())
    for (const station::CalibrationFile::Numbers& numbers : registration->file.parameters)
      if (numbers.name == "X_EM_position_m")
        return {kPrint, State::well,
                "camera and device agreed on lengths at the registration of " +
                    registration->file.date.substr(0, 10)};
  return {kPrint, State::note, "nobody has measured it",
          "Lay a ruler on the bar of 100 mm beside the tags, and tell: palpa doctor --bar 99.5"};
}

Finding askRecords(const std::string& url, std::size_t waiting) {
  using record::StoreState;
  try {
    const record::StoreLook look = record::lookAtStore(url);
    if (look.state == StoreState::absent)
      return {"records", State::well,
              "none so far; the first trainee makes " + url + waitingWords(waiting)};
    if (look.state == StoreState::empty)
      return {"records", State::note, look.place + ": is empty" + waitingWords(waiting),
              "If there were trainees in it, restore a backup (palpa records restore); if it is "
              "new, nothing: the first trainee fills it"};
    const std::string verdict = std::to_string(look.trainees) +
                                (look.trainees == 1 ? " trainee in " : " trainees in ") +
                                look.place + waitingWords(waiting);
    if (look.state == StoreState::older)
      return {"records", State::note,
              verdict + "; older (tables " + std::to_string(look.schema) +
                  "): they will be brought to the newest version when a session uses them",
              "Copy them first if a station with an older Palpa is to read them again; else "
              "nothing, or: palpa records migrate"};
    if (waiting > 0)
      return {"records", State::note, verdict, "Deliver them: palpa records deliver"};
    return {"records", State::well, verdict};
  } catch (const std::exception& e) {
    return troubled("records", State::note, e.what());
  }
}

}  // namespace palpa::doctor
