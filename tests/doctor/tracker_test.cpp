#include "apps/doctor/device_check.h"

#include <atomic>
#include <thread>

#include "apps/link/igtl/conventions.h"
#include "apps/link/igtl/igtl_server.h"
#include "apps/runtime/clock.h"
#include "says.h"

namespace palpa::doctor {
namespace {

station::TrackerSetup trackerAt(std::uint16_t port) {
  station::TrackerSetup setup;
  setup.host = "127.0.0.1";
  setup.port = port;
  setup.transform = "CameraMarkerToTable";
  return setup;
}

TrackerFacts factsOf(std::uint64_t poses, std::uint64_t unusable, std::uint64_t not_rigid,
                     std::uint64_t connections = 1) {
  return {{poses, unusable, not_rigid, 0, 0, connections}, 1, ""};
}

TEST(DoctorsTracker, EachTroubleIsNamed) {
  const station::TrackerSetup setup = trackerAt(18944);
  expectSays(judgeTracker(factsOf(0, 0, 0, 0), setup), State::ill,
             "does not answer at 127.0.0.1, port 18944");
  expectSays(judgeTracker(factsOf(0, 0, 0), setup), State::note, "sends no CameraMarkerToTable");
  expectSays(judgeTracker(factsOf(0, 40, 0), setup), State::note, "does not see");
  expectSays(judgeTracker(factsOf(0, 0, 40), setup), State::ill, "is not a pose");
  expectSays(judgeTracker(factsOf(15, 0, 0), setup), State::note, "15 poses a second");
  expectSays(judgeTracker(factsOf(60, 3, 0), setup), State::well, "60 poses a second");
  expectSays(judgeTracker({{}, 0, "\"nowhere\" is not known. Mend the name"}, setup), State::ill,
             "nowhere");
}

TEST(DoctorsTracker, IsListenedTo) {
  igt::IgtlServer plus("127.0.0.1", 0, Pose::Identity());
  plus.showAlways("CameraMarker", "Table", Pose::Identity());
  std::atomic<bool> stop{false}, sending{true};
  std::thread serving([&] {
    const runtime::SteadyClock clock;
    while (!stop) {
      if (sending) plus.show({});
      plus.serve({}, clock.now());
      clock.sleepUntil(clock.now() + 10 * runtime::kMillisecond);
    }
  });
  expectSays(askTracker(trackerAt(plus.port())), State::well, "poses a second");
  station::TrackerSetup misnamed = trackerAt(plus.port());
  misnamed.transform = "CameraToTable";
  expectSays(askTracker(misnamed, 0.5), State::note, "sends no CameraToTable");
  sending = false;
  expectSays(askTracker(trackerAt(plus.port()), 0.5), State::note, "sends no CameraMarkerToTable");
  stop = true;
  serving.join();
}

TEST(DoctorsTracker, NobodyThereAndNoSuchHostAreIll) {
  const std::uint16_t port = os::TcpListener("127.0.0.1", 0).port();
  expectSays(askTracker(trackerAt(port), 0.5), State::ill, "does not answer");
  station::TrackerSetup nowhere = trackerAt(port);
  nowhere.host = "no.such.host.invalid";
  expectSays(askTracker(nowhere, 0.5), State::ill, "no.such.host.invalid");
}

}  // namespace
}  // namespace palpa::doctor
