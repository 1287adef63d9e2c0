#include <string>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/console/routes.h"
#include "apps/os/file_access.h"
#include "apps/room/pairing.h"

/// The room: the other stations as the one console that watches them sees them, and this station's
/// picture for it.
namespace palpa::console {
namespace {

using nlohmann::json;
using room::RoomWatch;

constexpr char kKeyHeader[] = "X-Palpa-Room";
constexpr std::chrono::seconds kAnswers{5}, kPictureComes{2};
constexpr std::size_t kLargestPicture = 8u << 20;

json described(const room::BrokerLine::State& line) {
  return {{"stands", line.stands}, {"trouble", line.trouble}};
}

json described(const std::string& name, const RoomWatch::Station& station) {
  json one = toJson(station.state);
  one["name"] = name;
  one["url"] = station.about ? station.about->url : "";
  one["version"] = station.about ? station.about->version : "";
  one["events"] = station.events;
  return one;
}

/// Stations of the network that this room does not know.
json strangersIn(const room::Nearby& nearby, const room::Room& paired) {
  json all = json::array();
  for (const room::FoundConsole& one : nearby.found())
    if (!one.watches && !paired.stations().contains(one.station))
      all.push_back({{"name", one.name},
                     {"host", one.host},
                     {"port", one.port},
                     {"station", one.station},
                     {"version", one.version}});
  return all;
}

json described(const Console& c) {
  json all{{"joined", nullptr}, {"watch", nullptr}};
  if (c.joined) {
    all["joined"] = described(c.joined->line());
    all["joined"]["station"] = c.joined->name();
  }
  if (!c.room_trouble.empty())
    all["joined"] = {{"station", ""}, {"stands", false}, {"trouble", c.room_trouble}};
  if (!c.watch) return all;
  json stations = json::array();
  const room::Room paired = room::Room::in(c.room);
  for (const auto& [name, station] : c.watch->stations())
    if (paired.stations().contains(name)) stations.push_back(described(name, station));
  all["watch"] = {{"broker", described(c.watch->broker())},
                  {"trouble", c.watch->trouble()},
                  {"stations", stations}};
  if (c.nearby) {
    all["watch"]["strangers"] = strangersIn(*c.nearby, paired);
    all["watch"]["nearby_trouble"] = c.nearby->trouble();
  }
  return all;
}

RoomWatch& watchOf(const Console& c) {
  if (!c.watch)
    throw UsageError("watches no room", "this console",
                     "Start it with --room and the room's folder");
  return *c.watch;
}

/// From the station itself, over TLS that only the authority that it named vouches for (of a
/// centre's own certificate: those that this computer believes). Empty: it has none to give.
std::string pictureOf(const room::StationFacts& station) {
  if (station.url.empty()) return "";
  const os::TemporaryFolder believed("palpa-room-");
  httplib::Client client(station.url.substr(0, station.url.size() - 1));
  if (!station.authority.empty()) {
    const auto file = believed.path() / "authority.pem";
    writeWhole(file, station.authority, Lasts::no);
    client.set_ca_cert_path(file.string());
  }
  client.enable_server_certificate_verification(true);
  client.set_connection_timeout(kPictureComes);
  client.set_read_timeout(kPictureComes);
  std::string picture;
  const auto until = runtime::ServingClock::now() + 2 * kPictureComes;
  const auto result = client.Get(
      kRoomPicture, {{kKeyHeader, station.picture_key}},
      [](const httplib::Response& answer) { return answer.status == 200; },
      [&](const char* bytes, std::size_t count) {
        picture.append(bytes, count);
        return picture.size() <= kLargestPicture && runtime::ServingClock::now() < until;
      });
  return result && picture.starts_with("\xff\xd8") ? picture : "";
}

void sendPictureOf(Console& c, const std::string& name, httplib::Response& r) {
  const auto stations = watchOf(c).stations();
  const auto found = stations.find(name);
  if (found == stations.end() || !found->second.about) return refuse(r, 404, "is not in the room");
  r.status = 204;  // nothing to show now is no error
  const auto taken = runtime::ServingClock::now();
  if (!c.picture_places.take(name, taken)) return;
  std::string picture;
  try {
    picture = pictureOf(*found->second.about);
  } catch (const std::exception&) {  // no room for the authority's file, say
  }
  c.picture_places.giveBack(name, taken, runtime::ServingClock::now());
  if (picture.empty()) return;
  r.status = 200;
  r.set_content(picture, "image/jpeg");
}

void askOf(Console& c, const std::string& name, const json& asked, httplib::Response& r) {
  json message = asked;
  message["id"] = randomKey();
  const room::Ask ask = room::askIn(room::wire(message));
  if (!watchOf(c).stations().contains(name)) return refuse(r, 404, name + " is not in the room");
  const auto answered = watchOf(c).ask(name, ask, kAnswers);
  if (!answered)
    return refuse(r, 504,
                  name + " did not answer: whether it was done is not known. Look at the station");
  if (!answered->done) return refuse(r, 409, name + ": " + answered->words);
  answer(r, json::object());
}

/// This station's own, for who watches the room.
void sendOwnPicture(Console& c, const httplib::Request& q, httplib::Response& r) {
  if (!c.joined || !c.joined->isPictureKey(q.get_header_value(kKeyHeader)))
    return refuse(r, 403, "is for the console that watches this room");
  const std::string id = c.sessions.running();
  if (id.empty() || c.sessions.isBlind(id)) return refuse(r, 404, "there is no picture");
  const auto link = c.sessions.link(id);
  const auto picture = link ? link->picture(0, kPictureComes / 2) : SessionLink::Picture{};
  if (!picture.jpeg) return refuse(r, 404, "there is no picture yet");
  r.set_content(*picture.jpeg, "image/jpeg");
}

}  // namespace

bool PicturePlaces::take(const std::string& station, Time now) {
  const std::lock_guard lock(mutex_);
  const auto known = in_peace_.find(station);
  if (known != in_peace_.end() && now < known->second) return false;
  return asked_.size() < kMost && asked_.insert(station).second;
}

void PicturePlaces::giveBack(const std::string& station, Time taken, Time now) {
  const std::lock_guard lock(mutex_);
  asked_.erase(station);
  if (now - taken > kSlow)
    in_peace_[station] = now + kInPeace;
  else
    in_peace_.erase(station);
}

void addRoomRoutes(WebServer& server, Console& c) {
  server.Get("/api/room",
             [&c](const httplib::Request&, httplib::Response& r) { answer(r, described(c)); });
  server.Get(R"(/api/room/([A-Za-z0-9_-]{1,32})/events)",
             [&c](const httplib::Request& q, httplib::Response& r) {
               json all = json::array();
               for (const room::Kept& kept : watchOf(c).happenings(q.matches[1])) {
                 all.push_back(toJson(kept.happening));
                 all.back()["utc"] = kept.utc;
               }
               answer(r, all);
             });
  server.Get(
      R"(/api/room/([A-Za-z0-9_-]{1,32})/picture)",
      [&c](const httplib::Request& q, httplib::Response& r) { sendPictureOf(c, q.matches[1], r); });
  server.Post(R"(/api/room/([A-Za-z0-9_-]{1,32})/ask)",
              [&c](const httplib::Request& q, httplib::Response& r) {
                askOf(c, q.matches[1], bodyOf(q), r);
              });
  server.Get(kRoomPicture,
             [&c](const httplib::Request& q, httplib::Response& r) { sendOwnPicture(c, q, r); });
}

}  // namespace palpa::console
