#include "apps/cli/commands.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>

#include "anatomy/base/error.h"
#include "anatomy/base/utc.h"
#include "apps/cli/arguments.h"
#include "apps/cli/values.h"
#include "apps/console/console.h"
#include "apps/evidence/told_events.h"
#include "apps/os/child_process.h"
#include "apps/os/file_access.h"
#include "apps/os/local_socket.h"
#include "apps/room/pairing.h"
#include "apps/runtime/clock.h"
#include "apps/station/assets.h"
#include "apps/station/station_file.h"

namespace palpa::cli {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kShortestToken = 16;

struct ConsoleOptions {
  std::string listen = "127.0.0.1", token_file, records, home, station, room_camera, certificate,
              key, room;
  std::vector<std::string> names;
  int port = 0;
  bool open = true, tls = false;
};

/// The first line; a file that others may read gives its token away.
std::string tokenIn(const std::string& file) {
  if (file.empty()) return "";
  const os::Privacy privacy = os::privacyOf(file);
  if (privacy == os::Privacy::missing)
    throw UsageError("is not there", "--token-file " + file,
                     "Write a token of at least 16 letters and digits into it");
  if (privacy == os::Privacy::shared)
    throw UsageError("may be read by others", "--token-file " + file, "chmod 600 " + file);
  std::string token;
  std::getline(std::ifstream(file), token);
  if (token.size() < kShortestToken)
    throw UsageError("holds fewer than 16 characters", "--token-file " + file,
                     "Make one: head -c 24 /dev/urandom | base64 > " + file);
  return token;
}

void openInBrowser(const std::string& url) {
  if (!os::startProgram("xdg-open", {url}))
    std::fprintf(stderr, "No browser could be opened: type the address into one\n");
}

console::ConsoleSettings settingsOf(const ConsoleOptions& o) {
  console::ConsoleSettings s;
  s.place.home = fs::absolute(o.home.empty() ? usualConsoleHome() : fs::path(o.home));
  s.place.pages = station::assetFile("console");
  s.place.records = o.records;
  s.place.sockets = os::socketFolder();
  s.place.version = PALPA_VERSION;
  s.place.display = std::getenv("DISPLAY") != nullptr;
  if (!o.room_camera.empty() && !fs::exists(o.room_camera))
    throw UsageError("is not there", "--room-camera " + o.room_camera,
                     "Plug it in, or leave it out");
  s.place.room_camera = o.room_camera;
  s.address = o.listen;
  s.port = o.port;
  s.token = tokenIn(o.token_file);
  s.names = o.names;
  s.tls = o.tls;
  s.certificate = o.certificate;
  s.key = o.key;
  if (!o.room.empty() && !fs::exists(o.room))
    throw UsageError("is not there", "--room " + o.room,
                     "Give a room's folder to watch it, or a station's pairing file to join it: "
                     "palpa console pair --help");
  s.room = o.room;
  s.tone = evidence::toneOfEvent;
  if (!o.station.empty()) {
    station::readStation(o.station);  // refused here, where somebody reads it
    s.station = fs::absolute(o.station).string();
  }
  return s;
}

struct PairOptions {
  std::string station, broker, room, out;
  int port = 0;
  bool forget = false;
};

fs::path folderOf(const PairOptions& o) {
  return o.room.empty() ? usualConsoleHome().parent_path() / "room" : fs::path(o.room);
}

void forget(const PairOptions& o) {
  room::Room::in(folderOf(o));  // or a folder would be made
  const room::RoomChange alone(folderOf(o));
  room::Room room = room::Room::in(folderOf(o));
  if (!room.forget(o.station))
    throw UsageError("is not paired", o.station,
                     "Paired stations stand in " + (folderOf(o) / "room.json").string());
  std::printf(
      "%s may no longer speak in the room, once its broker has read its files again: "
      "pkill -HUP mosquitto\n",
      o.station.c_str());
}

/// A room is made by its first station, at the address that it names.
room::Room roomFor(const PairOptions& o, std::chrono::sys_seconds now) {
  constexpr int kUsualPort = 8883;
  const fs::path folder = folderOf(o);
  if (o.broker.empty() && o.port != 0)
    throw UsageError("is of a new room's broker", "--port", "Give --broker HOST as well");
  if (o.broker.empty()) return room::Room::in(folder);
  const bool there = fs::exists(folder / "room.json");
  const int port = o.port != 0 ? o.port : there ? room::Room::in(folder).port() : kUsualPort;
  return room::Room::made(folder, o.broker, port, now);
}

void pair(const PairOptions& o) {
  const auto now = utcSecondsOf(runtime::utcNow());
  const fs::path file = o.out.empty() ? fs::path(o.station + ".palpa-pairing") : fs::path(o.out);
  room::needStationName(o.station);
  if (o.broker.empty()) room::Room::in(folderOf(o));  // or a folder would be made
  const room::RoomChange alone(folderOf(o));
  if (fs::exists(file))
    throw UsageError("is there already", file.string(), "Remove it, or choose another with --out");
  room::Room room = roomFor(o, now);
  room.pair(o.station, now, [&file](const room::Pairing& made) { writePairing(file, made); });
  std::printf(
      "%s is paired: bring %s to that station, and start its console there with --room %s\n"
      "Whoever has that file can speak as this station: delete the copies on the way\n"
      "The room's broker: /usr/sbin/mosquitto -c %s (one that runs: pkill -HUP mosquitto)\n"
      "Watch the room: palpa console --room %s\n",
      o.station.c_str(), file.c_str(), file.filename().c_str(), room.brokerSettings().c_str(),
      room.brokerSettings().parent_path().c_str());
}

void sayHowItIsKnown(const console::OpenedConsole& opened) {
  if (opened.fingerprint.empty()) return;
  std::printf("It is encrypted. Its certificate's SHA-256: %s\n", opened.fingerprint.c_str());
  if (opened.authority.empty()) return;
  std::printf("A tablet warns, unless this authority is installed there%s: %s, SHA-256 %s\n",
              opened.authority_is_new ? " (it is new)" : "", opened.authority.c_str(),
              opened.authority_fingerprint.c_str());
}

void serve(const ConsoleOptions& o) {
  const console::ConsoleSettings settings = settingsOf(o);
  setenv("LANGUAGE", "en", 1);  // what it starts writes for it; pages say that in any language
  serveConsole(settings, [&](const console::OpenedConsole& opened) {
    std::printf("The console: %s\n", opened.url.c_str());
    sayHowItIsKnown(opened);
    if (!settings.token.empty()) std::printf("It asks for the token in %s\n", o.token_file.c_str());
    std::printf(
        "Ctrl-C ends it; a running session continues, and is found again when the console is "
        "back\n");
    std::fflush(stdout);
    if (o.open && settings.place.display) openInBrowser(opened.url);
  });
  std::printf("The console has ended\n");
}

}  // namespace

void runConsole() {
  ConsoleOptions o;
  o.records = usualRecordsMade();
  serve(o);
}

namespace {

void addPair(CLI::App& console) {
  const auto o = std::make_shared<PairOptions>();
  CLI::App* command = console.add_subcommand(
      "pair", "Give a station its place in a room of stations, which one console watches");
  command->add_option("station", o->station, "The station's name: letters, digits, - and _")
      ->required();
  command
      ->add_option("--broker", o->broker,
                   "Name or address by which stations reach this computer, where the room's broker "
                   "runs; needed for the first station")
      ->type_name("HOST");
  command->add_option("--port", o->port, "Port of a new room's broker (default 8883)")
      ->check(inRange(1, 65535));
  command
      ->add_option("--room", o->room,
                   "The room's folder: its certificates and the broker's settings (default "
                   "~/.local/share/palpa/room)")
      ->type_name("DIR");
  command->add_option("--out", o->out, "The station's pairing file (default STATION.palpa-pairing)")
      ->type_name("FILE");
  command->add_flag("--forget", o->forget, "Take a station's place in the room away");
  command->footer(
      "Examples:\n  palpa console pair bench1 --broker desk.local\n  palpa console pair bench2\n"
      "  palpa console pair bench2 --forget");
  command->callback([o] { o->forget ? forget(*o) : pair(*o); });
}

}  // namespace

void addConsole(CLI::App& program) {
  const auto o = std::make_shared<ConsoleOptions>();
  CLI::App* command = program.add_subcommand(
      "console",
      "The educator's pages: station, calibration, trainees, sessions, results, replay, studies");
  command
      ->add_option(
          "--listen", o->listen,
          "Address to listen on (default 127.0.0.1: this computer only); others need --token-file, "
          "and are encrypted")
      ->type_name("ADDRESS");
  command->add_option("--port", o->port, "Port (default: any free one)")->check(inRange(1, 65535));
  command
      ->add_option("--token-file", o->token_file,
                   "File with the token that anyone who opens the pages must enter; only you may "
                   "be able to read it")
      ->type_name("FILE");
  command->add_flag("--tls", o->tls,
                    "Encrypt also what stays on this computer (an address that others can reach is "
                    "always encrypted)");
  CLI::Option* const certificate =
      command
          ->add_option(
              "--tls-certificate", o->certificate,
              "Certificate of the centre's own (PEM, with those above it; best with an ECDSA "
              "key); default: one that the console makes")
          ->type_name("FILE");
  CLI::Option* const key =
      command->add_option("--tls-key", o->key, "Its key (PEM, without a password)")
          ->type_name("FILE")
          ->needs(certificate);
  certificate->needs(key);
  command
      ->add_option("--name", o->names,
                   "Another name by which browsers reach this computer, e.g. station3.local")
      ->type_name("HOST");
  command
      ->add_option("--room", o->room,
                   "A room's folder: this console watches its stations; or a pairing file: this "
                   "station joins that room (palpa console pair --help)")
      ->type_name("PATH");
  command
      ->add_option("--home", o->home,
                   "Where the console keeps its sessions (default ~/.local/share/palpa/console)")
      ->type_name("DIR");
  command
      ->add_option("--station", o->station,
                   "Station file to use from now on (default: the last one used; at first the "
                   "virtual bench)")
      ->type_name("FILE");
  command
      ->add_option(
          "--room-camera", o->room_camera,
          "Camera that can film a session's room (a device such as /dev/video2; or a film, "
          "to try it): offered where a session is begun, for those who agree")
      ->type_name("CAMERA");
  command->add_flag_callback(
      "--no-open", [o] { o->open = false; }, "Do not open a browser");
  addRecordsArgument(*command, o->records);
  command->footer(
      "Examples:\n  palpa console\n  palpa console --port 8080 --no-open\n  palpa console --listen "
      "192.168.1.20 --port 8080 --token-file ~/palpa-token\n      for a tablet: its pages are "
      "encrypted");
  addPair(*command);
  addLearning(*command);
  command->callback([o, command] {
    if (command->get_subcommands().empty()) serve(*o);
  });
}

}  // namespace palpa::cli
