#include "apps/session/session_igtl.h"

#include <cstdio>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/parametric/phantoms.h"
#include "apps/os/socket.h"

namespace palpa::session {
namespace {

igt::IgtlLinkSetup linkOf(const SessionOptions& options, const station::Station& station,
                          const SessionIgtl::Shown& shown, const runtime::Clock& clock) {
  igt::IgtlLinkSetup setup;
  setup.ipv4 = options.igtl_listen;
  setup.port = static_cast<std::uint16_t>(options.igtl_port);
  setup.utc_start_ns = runtime::dateNow() - clock.now();
  setup.tool = shown.needle ? "Needle" : "Probe";
  setup.X_WA = shown.X_WA;
  setup.X_WD = station.X_WD;
  setup.X_ET = shown.X_ET;
  if (shown.two_tools) setup.second_X_WD = station.second_X_WD;
  if (!shown.needle)
    setup.X_WP = shown.X_WA * anatomy::X_AP();  // what is palpated, squeezed or searched
  return setup;
}

igt::TrackerSettings trackerOf(const station::TrackerSetup& setup) {
  return {setup.host, setup.port,         setup.transform, setup.X_CK,
          setup.X_RW, setup.ask_tdata_ms, setup.latency_s};
}

}  // namespace

SessionIgtl::SessionIgtl(const SessionOptions& options, const station::Station& station,
                         const Shown& shown, runtime::Bus& bus, const runtime::Clock& clock) {
  if (station.tracker && options.camera.empty()) {
    if (options.fast)
      throw UsageError("needs real time", station.file.name() + ", tracker", "Leave out --fast");
    tracker_.emplace(trackerOf(*station.tracker), clock, bus.tracker_to_camera);
  }
  if (options.igtl_port == 0) return;
  link_.emplace(linkOf(options, station, shown, clock), bus);
  if (options.quiet) return;
  std::printf("OpenIGTLink: this session is served at %s, port %d\n", options.igtl_listen.c_str(),
              link_->server().port());
  if (!os::isLoopbackAddress(options.igtl_listen))
    std::puts(
        "Whoever reaches this computer there can listen: what is served holds no names, but it is "
        "not encrypted");
  std::fflush(stdout);
}

void SessionIgtl::addTo(runtime::Executive& executive) {
  if (tracker_) executive.add(*tracker_, {0, false, false});
  if (link_) executive.add(*link_, {9, false, false});
}

void SessionIgtl::finish(std::int64_t now_ns) {
  if (link_) link_->step(now_ns);
}

std::vector<report::Fact> SessionIgtl::facts() const {
  std::vector<report::Fact> facts;
  if (tracker_) {
    const igt::TrackerCounts c = tracker_->counts();
    facts.push_back({"Poses of the tracking system", std::to_string(c.poses),
                     std::to_string(c.unusable) + " more that it called unusable, " +
                         std::to_string(c.not_rigid) + " that were no pose, " +
                         std::to_string(c.damaged) + " damaged messages; connected " +
                         howOften(c.connections)});
  }
  if (link_)
    facts.push_back({"Listeners by OpenIGTLink", std::to_string(link_->server().everConnected()),
                     std::to_string(link_->server().lostEvents()) +
                         " events were lost to those who read too slowly"});
  return facts;
}

}  // namespace palpa::session
