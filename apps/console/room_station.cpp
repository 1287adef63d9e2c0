#include "apps/console/room_station.h"

#include <openssl/crypto.h>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/utc.h"
#include "apps/console/blinding.h"
#include "apps/console/routes.h"
#include "apps/console/task_choices.h"
#include "apps/os/real_time.h"
#include "apps/record/session_file.h"

namespace palpa::console {
namespace {

using nlohmann::json;
using room::Answer;
using room::Ask;
using room::Happening;
using std::chrono::milliseconds;

constexpr milliseconds kRound{200};
constexpr std::chrono::seconds kBetweenRecords{2};

std::string textIn(const json& entry, const char* field) {
  const json found = entry.value(field, json());
  return found.is_string() ? found.get<std::string>() : "";
}

/// An event of a session's log as the room hears it: a note's words stay here.
Happening happeningOf(const json& entry, const std::string& session, const std::string& record,
                      std::int64_t after) {
  constexpr std::size_t kLongest = 400;
  const std::string event = textIn(entry, "event");
  const bool note = event == nameOf(runtime::EventKind::note);
  return {.session = session,
          .record = record,
          .number = entry.at("number"),
          .after = after,
          .t_s = std::max(0.0, entry.value("t_s", 0.0)),
          .trial = std::max(0, entry.value("trial", 0)),
          .event = event,
          .text = note ? "Somebody noted something" : textIn(entry, "text").substr(0, kLongest),
          .tone = textIn(entry, "tone")};
}

bool isEvent(const json& entry) {
  return entry.is_object() && entry.value("kind", json()) == "event" &&
         entry.value("number", json()).is_number_integer();
}

/// What the newest words on a session's screen say of it.
void addStatus(const json& entry, room::StationState* state) {
  state->state = textIn(entry, "state");
  state->trial = entry.value("trial", 0);
  state->trials = entry.value("trials", 0);
  state->elapsed_s = entry.value("elapsed_s", 0.0);
  state->emergency_stop = entry.value("emergency_stop", false);
  state->alarm = state->emergency_stop         ? "Emergency stop"
                 : entry.value("alarm", false) ? textIn(entry, "notice")
                                               : "";
}

/// The same record of which a session tells live, read when it is over.
std::vector<Happening> happeningsIn(const std::filesystem::path& record, const std::string& session,
                                    bool blind, const live::ToneOf& tone) {
  const record::SessionReader reader(record);
  std::vector<Happening> all;
  std::int64_t number = 0, after = -1;
  for (const runtime::Event& event : reader.events()) {
    std::string told = live::eventEntry(event, number++, tone);
    if (blind && !told.empty()) told = blinded(told);
    const json entry = parsedOrDiscarded(told);
    if (!isEvent(entry)) continue;
    all.push_back(happeningOf(entry, session, reader.info().uuid, after));
    after = all.back().number;
  }
  return all;
}

}  // namespace

RoomStation::RoomStation(Console& console, const room::Pairing& pairing, const std::string& url,
                         const std::string& authority)
    : console_(console),
      pairing_(pairing),
      picture_key_(randomKey()),
      line_(pairing, {url, authority, picture_key_, console.place.version},
            [this](const Ask& ask) { return obey(ask); }) {
  thread_ = os::startThread([this] { run(); });
}

RoomStation::~RoomStation() {
  ending_.store(true);
  thread_.join();
}

bool RoomStation::isPictureKey(const std::string& key) const {
  return key.size() == picture_key_.size() &&
         CRYPTO_memcmp(key.data(), picture_key_.data(), key.size()) == 0;
}

void RoomStation::run() {
  os::giveWay();
  while (!ending_.load()) {
    try {
      follow();
      tellOldest();
    } catch (const std::exception&) {  // a full disk, say: the next time
    }
    line_.look();
    runtime::rest(kRound);
  }
}

void RoomStation::follow() {
  const std::string id = console_.sessions.running();
  if (id != on_) {
    on_ = id;
    link_ = id.empty() ? nullptr : console_.sessions.link(id);
    state_from_ = events_from_ = 0;
    record_.clear();
    lost_ = false;
    state_ = {};
    if (link_) {
      const json one = console_.sessions.one(id);
      state_.session = id;
      state_.state = "starting";
      state_.task = textIn(one, "title");
      state_.trainee = textIn(one, "trainee");
      state_.simulated = one.value("simulated", json()) == true;
      state_.blind = one.value("blind", json()) == true;
    }
  }
  if (link_) {
    followState();
    followEvents();
  }
  state_.present = true;
  state_.utc = runtime::utcNow();
  line_.show(state_);
}

void RoomStation::followState() {
  const SessionLink::News news = link_->wait(state_from_, milliseconds(0));
  state_from_ = news.from + news.entries.size();
  for (auto text = news.entries.rbegin(); text != news.entries.rend(); ++text) {
    const json entry = parsedOrDiscarded(*text);
    if (!entry.is_object() || entry.value("kind", json()) != "status") continue;
    return addStatus(entry, &state_);
  }
}

/// Up to the first that cannot be told yet.
void RoomStation::followEvents() {
  if (lost_ || !line_.wants(on_).value_or(false)) return;
  const SessionLink::News news = link_->wait(events_from_, milliseconds(0));
  events_from_ = news.from;
  for (const std::string& text : news.entries) {
    if (!tell(parsedOrDiscarded(text))) return;
    ++events_from_;
  }
}

bool RoomStation::tell(const json& entry) {
  if (!entry.is_object()) return true;
  const json kind = entry.value("kind", json());
  if (kind == "earlier") lost_ = true;
  if (kind == "hello") {
    record_ = textIn(entry, "uuid");
    last_ = -1;
  }
  if (lost_ || record_.empty() || !isEvent(entry)) return true;
  const Happening happening = happeningOf(entry, on_, record_, last_);
  if (!line_.tell(happening)) return false;
  last_ = happening.number;
  return true;
}

/// What the oldest session that is over has to tell; true: there is one.
bool RoomStation::readNext() {
  for (const std::string& id : console_.sessions.untold()) {
    if (unreadable_.contains(id)) continue;
    const auto began = utcSecondsOf(textIn(console_.sessions.one(id), "started_utc"));
    if (!line_.wants(id).value_or(false) || began < utcSecondsOf(pairing_.made_utc)) {
      console_.sessions.markTold(id);
      continue;
    }
    try {
      recorded_.clear();
      recorded_from_ = 0;
      for (const auto& record : console_.sessions.records(id))
        for (Happening& one :
             happeningsIn(record, id, console_.sessions.isBlind(id), console_.tone))
          recorded_.push_back(std::move(one));
      over_ = id;
      return true;
    } catch (const Error&) {  // its own page says what is wrong with it
      unreadable_.insert(id);
    }
  }
  return false;
}

void RoomStation::tellOldest() {
  if (over_.empty()) {
    const auto now = runtime::ServingClock::now();
    if (now < next_look_ || !line_.wants("").has_value()) return;
    next_look_ = now + kBetweenRecords;
    if (!readNext()) return;
  }
  while (recorded_from_ < recorded_.size() && line_.tell(recorded_[recorded_from_]))
    ++recorded_from_;
  for (const Happening& one : recorded_)
    if (line_.heardOf(one.session, one.record) < one.number) return;
  console_.sessions.markTold(over_);
  over_.clear();
}

/// Nothing here begins force: a session that was prepared waits for a key or a button here.
Answer RoomStation::obey(const Ask& ask) {
  if (ask.what == Ask::What::prepare) {
    SessionWish wish = readWish(ask.wish);
    wish.film = false;  // who trains agrees at the station
    if (wish.performer != "person" &&
        !onBench(console_.place, stationKindOf(taskChoice(wish.task).engine)))
      return {ask.id, false, "a simulated operator performs on the virtual bench only"};
    beginSession(console_, wish);
    return {ask.id, true, ""};
  }
  const std::string id = console_.sessions.running();
  const auto link = id.empty() ? nullptr : console_.sessions.linkForStop(id);
  if (!link) return {ask.id, false, "no session is running there"};
  if (ask.what == Ask::What::stop) {
    const bool stopped = link->stop() == SessionLink::Stopped::yes;
    return {ask.id, stopped,
            stopped ? "" : "the session was told to stop and has not confirmed it"};
  }
  const json command{{"command", nameOf(ask.what)}};
  return link->send(command.dump()) ? Answer{ask.id, true, ""}
                                    : Answer{ask.id, false, "the session does not listen"};
}

}  // namespace palpa::console
