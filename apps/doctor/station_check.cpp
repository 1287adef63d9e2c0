#include "apps/doctor/station_check.h"

#include "anatomy/geometry/error.h"
#include "apps/record/store/record_store.h"
#include "apps/record/store/sql_connection.h"
#include "apps/station/calibrations.h"

namespace palpa::doctor {
namespace {

constexpr const char* kAnew = "Calibrate it anew: palpa calibrate all; until then sessions are not scored";

std::string waitingWords(std::size_t waiting) {
  if (waiting == 0) return "";
  return waiting == 1 ? "; one session waits to be delivered" : "; " + std::to_string(waiting) + " sessions wait to be delivered";
}

/// Empty: nothing is wrong.
std::string faultIn(const station::Station& station, const station::AppliedCalibration& one, const std::string& now_utc) {
  if (std::string fault = station::faultIn(one, station.calibrations, station.id); !fault.empty()) return fault;
  if (one.file.date > now_utc) return "it was made on " + one.file.date.substr(0, 10) + ", which is still to come: the computer's date is wrong, or was";
  return station::outdatedOn({one}, now_utc);
}

}  // namespace

std::optional<station::Station> readStation(const std::filesystem::path& file, Findings* findings) {
  try {
    station::Station station = station::readStation(file);
    findings->push_back({"station", State::well, station.title + (station.simulated ? " (simulated)" : "")});
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
    const std::string subject = one.file.kind + " calibration", fault = faultIn(station, one, now_utc);
    if (fault.empty()) findings.push_back({subject, State::well, "of " + one.file.date.substr(0, 10) + ", good for " + std::to_string(one.file.valid_days) + " days"});
    else findings.push_back({subject, State::note, fault, kAnew});
  }
  if (!findings.empty()) return findings;
  if (station.calibration_verdict == "pass") return {{"calibrations", State::well, "as the station's file states them" + (station.calibration_date.empty() ? "" : ": " + station.calibration_date)}};
  return {{"calibrations", State::note, station.calibration_verdict.empty() ? "there are none" : station.calibration_verdict, kAnew}};
}

Finding askRecords(const std::string& url, std::size_t waiting) {
  std::error_code none;
  if (!record::isServer(url) && !std::filesystem::exists(url, none)) return {"records", State::well, "none so far; the first trainee makes " + url + waitingWords(waiting)};
  try {
    record::RecordStore store(url);
    const std::size_t trainees = store.trainees().size();
    const std::string verdict = std::to_string(trainees) + (trainees == 1 ? " trainee in " : " trainees in ") + store.place() + waitingWords(waiting);
    if (waiting > 0) return {"records", State::note, verdict, "Deliver them: palpa records deliver"};
    return {"records", State::well, verdict};
  } catch (const std::exception& e) {
    return troubled("records", State::note, e.what());
  }
}

}  // namespace palpa::doctor
