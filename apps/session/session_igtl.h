#pragma once

#include <optional>

#include "apps/link/igtl/session_link.h"
#include "apps/link/igtl/tracker_client.h"
#include "apps/session/session_devices.h"
#include "apps/session/session_options.h"

namespace palpa::session {

/// A session's doors to OpenIGTLink: who listens to it (`--igtl`), and the tracking system that the
/// station's file names. Both or neither may be there.
class SessionIgtl {
 public:
  struct Shown {
    Pose X_WA;
    Pose X_ET;
    bool needle = true;
    bool two_tools = false;
  };
  /// Throws UsageError / Error: an address that is none, a port that is taken, a tracking system in
  /// virtual time.
  SessionIgtl(const SessionOptions& options, const station::Station& station, const Shown& shown,
              runtime::Bus& bus, const runtime::Clock& clock);

  void addTo(runtime::Executive& executive);
  /// After the recorder has finished: what was recorded last is told, too.
  void finish(std::int64_t now_ns);
  std::vector<report::Fact> facts() const;  ///< after the session

 private:
  std::optional<igt::IgtlLink> link_;
  std::optional<igt::TrackerClient> tracker_;
};

}  // namespace palpa::session
