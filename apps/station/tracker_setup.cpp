#include "apps/station/tracker_setup.h"

#include <numbers>

#include "apps/station/device_setup.h"

namespace palpa::station {

std::optional<TrackerSetup> readTracker(const JsonFile& file) {
  if (!file.has("tracker")) return std::nullopt;
  if (const std::string driver = file.text("tracker/driver"); driver != "plus")
    file.refuse("tracker/driver", "is \"" + driver + "\"; known: plus");
  TrackerSetup tracker;
  tracker.transform = file.text("tracker/transform");
  if (const std::size_t to = tracker.transform.find("To");
      to == 0 || to == std::string::npos || to + 2 == tracker.transform.size())
    file.refuse("tracker/transform", "is \"" + tracker.transform +
                                         "\": a name as ReferenceToCamera says which pose it is");
  if (file.has("tracker/host")) tracker.host = file.text("tracker/host");
  if (file.has("tracker/port"))
    tracker.port = static_cast<std::uint16_t>(file.integer("tracker/port", 1, 65'535));
  tracker.X_CK = readPose(file, "tracker/X_CK");
  tracker.X_RW = readPose(file, "tracker/X_RW");
  if (file.has("tracker/latency_ms"))
    tracker.latency_s = 1e-3 * file.number("tracker/latency_ms", 0, 500);
  if (file.has("tracker/stale_ms"))
    tracker.stale_s = 1e-3 * file.number("tracker/stale_ms", 10, 1000);
  if (file.has("tracker/sigma_mm"))
    tracker.sigma = 1e-3 * file.number("tracker/sigma_mm", 0.01, 10);
  if (file.has("tracker/sigma_deg"))
    tracker.sigma_rad = file.number("tracker/sigma_deg", 0.005, 5) * (std::numbers::pi / 180);
  if (file.has("tracker/ask_tdata_ms"))
    tracker.ask_tdata_ms = file.integer("tracker/ask_tdata_ms", 1, 1000);
  return tracker;
}

}  // namespace palpa::station
