#include "apps/room/watch.h"

#include <algorithm>
#include <fstream>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/whole_file.h"
#include "apps/os/file_access.h"

namespace palpa::room {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr char kPage[] = "events.jsonl", kPageBefore[] = "events-before.jsonl";
constexpr std::uintmax_t kLongestPage = 8u << 20;
constexpr std::size_t kNewest = 200, kMostSessions = 100, kMostRecords = 30, kMostNumbers = 300;
constexpr std::chrono::seconds kSilent{15};

std::size_t numbersIn(const Heard& heard) {
  std::size_t count = 0;
  for (const auto& [session, records] : heard.sessions) count += records.size();
  return count;
}

std::vector<std::string> everyTopic() {
  std::vector<std::string> all;
  for (const Topic one : {Topic::about, Topic::state, Topic::events, Topic::answers})
    all.push_back(topicOf("+", one));
  return all;
}

/// To a station: up to where he has its events, and since when he listens.
Said heardWords(const std::string& station, Heard heard, const std::string& since) {
  heard.since = since;
  return {topicOf(station, Topic::heard), wire(toJson(heard)), true};
}

/// What was heard of a station, at the head of a page.
json headOf(const std::string& station, const Heard& heard) {
  return {{"station", station}, {"heard", toJson(heard)}};
}

json lineOf(const std::string& station, const Kept& kept) {
  return {{"station", station}, {"utc", kept.utc}, {"event", toJson(kept.happening)}};
}

}  // namespace

RoomWatch::RoomWatch(BrokerAccess access, fs::path folder)
    : folder_(std::move(folder)), line_([&]() -> BrokerLine::Wish {
        if (const std::error_code problem = os::makeFolders(folder_))
          failFile("cannot be made", folder_, problem);
        read(folder_ / kPageBefore);
        read(folder_ / kPage);
        endLine();
        return {.access = std::move(access),
                .last_will = {},
                .topics = everyTopic(),
                .greets = [this] { return greeting(); },
                .hears = [this](const Said& said) { hears(said); }};
      }()) {}

/// A line that was cut off by a kill is none; the station tells it again.
void RoomWatch::read(const fs::path& file) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const json entry = parsedOrDiscarded(line);
    if (!entry.is_object() || !entry.contains("station") || !entry["station"].is_string()) continue;
    Known& known = stations_[entry["station"]];
    try {
      if (entry.contains("heard")) known.heard = heardIn(entry["heard"].dump());
      if (entry.contains("event"))
        note(&known, {entry.value("utc", ""), happeningIn(entry["event"].dump())});
    } catch (const std::exception&) {  // of another version, or damaged: what is told again comes
    }
  }
}

/// What is written next begins a line of its own.
void RoomWatch::endLine() const {
  const auto page = readWhole(folder_ / kPage);
  if (page && !page->empty() && page->back() != '\n')
    std::ofstream(folder_ / kPage, std::ios::app) << '\n';
}

void RoomWatch::note(Known* known, const Kept& kept) {
  const Happening& happening = kept.happening;
  known->heard.sessions[happening.session][happening.record] = happening.number;
  while (known->heard.sessions.size() > kMostSessions || numbersIn(known->heard) > kMostNumbers) {
    known->heard.beyond = known->heard.sessions.begin()->first;
    known->heard.sessions.erase(known->heard.sessions.begin());
  }
  known->newest.push_back(kept);
  if (known->newest.size() > kNewest) known->newest.pop_front();
}

/// Stations that were here before; those that come say so themselves.
std::vector<Said> RoomWatch::greeting() {
  const std::lock_guard lock(mutex_);
  since_ = std::to_string(runtime::ServingClock::now().time_since_epoch().count());
  std::vector<Said> all;
  for (const auto& [name, known] : stations_) all.push_back(heardWords(name, known.heard, since_));
  return all;
}

bool RoomWatch::keep(const std::string& line) {
  std::error_code none;
  const auto sizeNow = [&] {
    const std::uintmax_t size = fs::file_size(folder_ / kPage, none);
    return none ? std::uintmax_t{0} : size;
  };
  if (sizeNow() > kLongestPage) turnPage();
  const std::uintmax_t size = sizeNow();
  std::ofstream out(folder_ / kPage, std::ios::app);
  out << line << '\n' << std::flush;
  trouble_.clear();
  if (out) return true;
  fs::resize_file(folder_ / kPage, size, none);  // no half a line
  trouble_ = "Events of the room cannot be kept in " + folder_.string() +
             ": look whether the disk is full. The stations keep them";
  return false;
}

void RoomWatch::turnPage() {
  std::string heads;
  for (const auto& [name, known] : stations_) heads += wire(headOf(name, known.heard)) + "\n";
  std::error_code none;
  fs::rename(folder_ / kPage, folder_ / kPageBefore, none);
  if (none) return;  // the next time
  try {
    writeWhole(folder_ / kPage, heads, Lasts::no);
  } catch (const Error&) {  // the page before has them
  }
}

/// Only what follows on what is here: the rest is told again.
void RoomWatch::take(const std::string& station, const Happening& happening) {
  Known& known = stations_[station];
  const std::int64_t last = known.heard.of(happening.session, happening.record);
  if (happening.session <= known.heard.beyond || happening.number <= last) return;
  const auto its = known.heard.sessions.find(happening.session);
  if (last < 0 && its != known.heard.sessions.end() && its->second.size() >= kMostRecords) return;
  if (happening.number == last + 1) {
    const Kept kept{runtime::utcNow(), happening};
    if (!keep(wire(lineOf(station, kept)))) return;
    note(&known, kept);
    ++known.events;
  }
  line_.say(heardWords(station, known.heard, since_));
}

void RoomWatch::hears(const Said& said) {
  const auto addressed = addressedIn(said.topic);
  if (!addressed) return;
  const std::string& station = addressed->station;
  const std::lock_guard lock(mutex_);
  try {
    switch (addressed->topic) {
      case Topic::about:
        stations_[station].about = stationFactsIn(said.words);
        line_.say(heardWords(station, stations_[station].heard, since_));
        break;
      case Topic::state:
        stations_[station].state = stationStateIn(said.words);
        if (!said.retained) stations_[station].heard_at = runtime::ServingClock::now();
        break;
      case Topic::events:
        take(station, happeningIn(said.words));
        break;
      case Topic::answers: {
        const Answer answer = answerIn(said.words);
        if (const auto found = waited_for_.find(answer.id); found != waited_for_.end())
          found->second = answer;
        answered_.notify_all();
        break;
      }
      default:
        break;
    }
  } catch (const Error&) {  // a station of another version: its page would not say more
  }
}

std::map<std::string, RoomWatch::Station> RoomWatch::stations() const {
  const std::lock_guard lock(mutex_);
  std::map<std::string, Station> all(stations_.begin(), stations_.end());
  // A broker that was killed has no last wills.
  const auto now = runtime::ServingClock::now();
  for (auto& [name, station] : all)
    if (now - station.heard_at > kSilent) station.state = goneWithoutAWord();
  return all;
}

std::vector<Kept> RoomWatch::happenings(const std::string& station) const {
  const std::lock_guard lock(mutex_);
  const auto found = stations_.find(station);
  if (found == stations_.end()) return {};
  return {found->second.newest.begin(), found->second.newest.end()};
}

std::optional<Answer> RoomWatch::ask(const std::string& station, const Ask& ask,
                                     std::chrono::seconds patience) {
  if (!line_.state().stands) return std::nullopt;
  std::unique_lock lock(mutex_);
  waited_for_[ask.id] = std::nullopt;
  line_.say({topicOf(station, Topic::asks), wire(toJson(ask)), false, patience,
             ask.what == Ask::What::stop});
  answered_.wait_for(lock, patience, [&] { return waited_for_[ask.id].has_value(); });
  std::optional<Answer> answer = waited_for_[ask.id];
  waited_for_.erase(ask.id);
  return answer;
}

std::string RoomWatch::trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

}  // namespace palpa::room
