#include "apps/bench/room/room_parts.h"

#include <algorithm>
#include <fstream>
#include <thread>

#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/utc.h"
#include "anatomy/base/whole_file.h"
#include "apps/console/routes.h"
#include "apps/console/web/guard.h"
#include "apps/evidence/told_events.h"
#include "apps/os/real_time.h"
#include "apps/os/signals.h"
#include "apps/room/pairing.h"
#include "apps/session/needle_session.h"
#include "apps/session/session_records.h"
#include "apps/session/terminal.h"

namespace palpa::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
constexpr char kPart[] = "bench-room-part";

RoomPart readPart(const fs::path& file) {
  const JsonFile from(file, "palpa bench room writes it");
  RoomPart part;
  part.home = from.text("home");
  part.pairing = from.text("pairing");
  part.sockets = from.text("sockets");
  part.holds = from.json()["holds"].get<std::vector<std::string>>();
  part.held = from.text("held");
  part.recorded = from.text("recorded");
  part.result = from.text("result");
  part.seconds = from.number("seconds", 0, 1e6);
  part.seed = from.json()["seed"];
  part.trainee = from.text("trainee");
  part.records = from.text("records");
  return part;
}

std::string after(const char* option, const std::vector<std::string>& words) {
  const auto found = std::find(words.begin(), words.end(), option);
  if (found == words.end() || found + 1 == words.end())
    throw UsageError("is missing", option, "palpa bench room gives it");
  return *(found + 1);
}

console::SessionWish wishOf(const RoomPart& part) {
  console::SessionWish wish;
  wish.task = "paracentesis";
  wish.title = "Access to the subclavian vein";
  wish.trainee = part.trainee;
  wish.performer = "expert";
  wish.simulated = true;
  return wish;
}

/// Nobody comes to its pages; its sessions, its line to the room and what the room asks for are
/// those of every console.
void beStation(const RoomPart& part) {
  const os::InterruptNote interrupt(os::InterruptNote::Again::noted);
  console::Guard guard("");
  console::ConsolePlace place;
  place.home = part.home;
  place.sockets = part.sockets;
  place.records = part.records;
  place.version = PALPA_VERSION;
  console::Console console(place, guard, evidence::toneOfEvent);
  const auto now = utcSecondsOf(runtime::utcNow());
  console.joined =
      std::make_unique<console::RoomStation>(console, room::readPairing(part.pairing, now), "", "");
  os::giveWay();  // sessions do not: they are started by a thread of before
  while (!interrupt.noted()) {
    const bool again = part.held.empty() || !fs::exists(part.held);
    if (!part.holds.empty() && again && !console.sessions.oneRuns()) {
      if (!part.held.empty()) writeWhole(part.held, "", Lasts::no);
      console.sessions.begin(wishOf(part), part.holds);
    }
    runtime::rest(std::chrono::milliseconds(200));
  }
}

session::SessionOptions optionsOf(const RoomPart& part) {
  constexpr int kMoreThanAreHeld = 1000;
  session::SessionOptions options;
  options.who = session::OperatorKind::expert;
  options.seed = part.seed;
  options.trials = kMoreThanAreHeld;
  options.trainee = part.trainee;
  options.records = part.records;
  options.quiet = true;
  options.noted = false;
  options.display = scene::Display::offscreen;
  return options;
}

void holdInRealTime(const RoomPart& part, const std::vector<std::string>& words) {
  session::SessionOptions options = optionsOf(part);
  options.out = after("--out", words);
  if (std::find(words.begin(), words.end(), "--live") != words.end())
    options.live = after("--live", words);
  os::giveLargeMemoryBack();  // as every session in real time
  os::keepStacksSmall();
  session::settle(options);
  session::NeedleWorld world(options);
  const os::InterruptNote interrupt;
  // As its time is over it is ended as by a signal: what it has done until then is kept.
  std::jthread ends([&](const std::stop_token& sooner) {
    const auto until = runtime::ServingClock::now() + std::chrono::duration<double>(part.seconds);
    while (!sooner.stop_requested() && runtime::ServingClock::now() < until)
      runtime::rest(std::chrono::milliseconds(50));
    if (!sooner.stop_requested()) os::signalThisProcess();
  });
  const session::SessionResult result = session::runNeedleSession(options, world, options.out);
  ends = {};
  session::deliverSession(options, options.out);
  const auto haptic = std::find_if(result.lateness.begin(), result.lateness.end(),
                                   [](const auto& one) { return one.name == "haptic"; });
  if (haptic == result.lateness.end())
    throw Error("had no haptic loop", "the session", "Look into its log");
  writeWhole(part.result,
             json{{"ticks", haptic->steps},
                  {"median_us", haptic->median_us},
                  {"p99_us", haptic->p99_us},
                  {"p999_us", haptic->p999_us},
                  {"max_us", haptic->max_us},
                  {"missed", haptic->missed_ticks},
                  {"scheduling", haptic->scheduling}}
                 .dump(),
             Lasts::no);
}

}  // namespace

void write(const fs::path& file, const RoomPart& p) {
  writeWhole(file,
             json{{"home", p.home.string()},
                  {"pairing", p.pairing.string()},
                  {"sockets", p.sockets},
                  {"holds", p.holds},
                  {"held", p.held.string()},
                  {"recorded", p.recorded.string()},
                  {"result", p.result.string()},
                  {"seconds", p.seconds},
                  {"seed", p.seed},
                  {"trainee", p.trainee},
                  {"records", p.records}}
                 .dump(),
             Lasts::no);
}

bool isRoomPart(const std::vector<std::string>& words) {
  return words.size() >= 3 && words[0] == kPart;
}

std::vector<std::string> wordsOf(const char* kind, const fs::path& file) {
  return {kPart, kind, file.string()};
}

void beRoomPart(const std::vector<std::string>& words) {
  const RoomPart part = readPart(words[2]);
  if (words[1] == "session") return holdInRealTime(part, words);
  if (words[1] == "station") return beStation(part);
  os::giveWay();  // it stands for what another computer does
  playSession(
      {part.recorded, after("--out", words), after("--live", words), part.trainee, part.records});
}

}  // namespace palpa::bench
