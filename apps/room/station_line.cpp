#include "apps/room/station_line.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"
#include "apps/os/real_time.h"

namespace palpa::room {
namespace {

using runtime::ServingClock;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::size_t kMostUnderWay = 200, kAsksRemembered = 64, kMostAsks = 16;
/// Nobody waits longer for the answer.
constexpr seconds kAskIsGood{5};
constexpr seconds kFirstPatience{10}, kLongestPatience{600}, kSaidAnyhow{5};
constexpr milliseconds kShownApart{500};

/// The same, but for time that passes.
bool sameBut(StationState a, const StationState& b) {
  a.utc = b.utc;
  a.elapsed_s = b.elapsed_s;
  return toJson(a) == toJson(b);
}

Said lastWill(const std::string& station) {
  return {topicOf(station, Topic::state), wire(toJson(goneWithoutAWord())), true};
}

}  // namespace

StationLine::StationLine(const Pairing& pairing, const StationFacts& facts,
                         std::function<Answer(const Ask&)> handles)
    : station_(pairing.station),
      facts_(facts),
      handles_(std::move(handles)),
      patience_(kFirstPatience),
      line_({.access = pairing.broker,
             .last_will = lastWill(pairing.station),
             .topics = {topicOf(pairing.station, Topic::heard),
                        topicOf(pairing.station, Topic::asks)},
             .greets = [this] { return greeting(); },
             .hears = [this](const Said& said) { hears(said); }}),
      handler_(os::startThread([this] { handleAll(); })) {}

StationLine::~StationLine() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  came_.notify_all();
  handler_.join();
  line_.say(lastWill(station_));
}

Said StationLine::said(Topic topic, const nlohmann::json& message, bool retained) const {
  return {topicOf(station_, topic), wire(message), retained};
}

std::vector<Said> StationLine::greeting() {
  const std::lock_guard lock(mutex_);
  return {said(Topic::about, toJson(facts_), true), said(Topic::state, toJson(shown_), true)};
}

void StationLine::show(StationState state) {
  const std::lock_guard lock(mutex_);
  const auto now = ServingClock::now();
  const bool same = sameBut(state, shown_);
  if (now - shown_at_ < (same ? milliseconds(kSaidAnyhow) : kShownApart)) return;
  shown_ = std::move(state);
  shown_at_ = now;
  line_.say(said(Topic::state, toJson(shown_), true));
}

std::optional<bool> StationLine::wants(const std::string& session) const {
  const std::lock_guard lock(mutex_);
  if (!heard_) return std::nullopt;
  return session > heard_->beyond;
}

std::int64_t StationLine::heardOf(const std::string& session, const std::string& record) const {
  const std::lock_guard lock(mutex_);
  return heard_ ? heard_->of(session, record) : -1;
}

bool StationLine::tell(const Happening& happening) {
  const std::lock_guard lock(mutex_);
  if (!heard_) return false;
  const auto last = told_.find(happening.record);
  if (last != told_.end() && happening.number <= last->second.number) return true;
  const bool heard = happening.number <= heard_->of(happening.session, happening.record);
  if (!heard && under_way_.size() == kMostUnderWay) return false;
  told_[happening.record] = {happening.session, happening.number};
  if (heard) return true;
  if (under_way_.empty()) moved_ = ServingClock::now();
  under_way_.push_back(happening);
  line_.say(said(Topic::events, toJson(happening), false));
  return true;
}

int StationLine::beginnings() const {
  const std::lock_guard lock(mutex_);
  return beginnings_;
}

/// With the mutex held.
bool StationLine::missesWhatIsNotUnderWay() const {
  return std::any_of(told_.begin(), told_.end(), [&](const auto& one) {
    const std::string& record = one.first;
    const Told& told = one.second;
    const std::int64_t heard = heard_->of(told.session, record);
    if (told.session <= heard_->beyond || told.number <= heard) return false;
    return std::none_of(under_way_.begin(), under_way_.end(), [&](const Happening& h) {
      return h.record == record && h.number == heard + 1;
    });
  });
}

void StationLine::look() {
  const std::lock_guard lock(mutex_);
  if (under_way_.empty() || !line_.state().stands || ServingClock::now() - moved_ < patience_)
    return;
  patience_ = std::min(2 * patience_, kLongestPatience);
  tellAgain();
}

/// With the mutex held.
void StationLine::tellAgain() {
  moved_ = ServingClock::now();
  for (const Happening& one : under_way_) line_.say(said(Topic::events, toJson(one), false));
}

void StationLine::hearsOf(const Heard& heard) {
  const std::lock_guard lock(mutex_);
  const std::size_t before = under_way_.size();
  const bool listens_anew = heard_ && heard_->since != heard.since;
  heard_ = heard;
  std::erase_if(under_way_, [&](const Happening& one) {
    return one.session <= heard.beyond || one.number <= heard.of(one.session, one.record);
  });
  const bool moved = under_way_.size() < before;
  const bool was_lost =  // on the way
      !moved && !under_way_.empty() && ServingClock::now() - moved_ > seconds(1);
  patience_ = kFirstPatience;
  if (missesWhatIsNotUnderWay()) {  // his pages are gone, or older than they were
    told_.clear();
    under_way_.clear();
    ++beginnings_;
  } else if (listens_anew || was_lost) {
    tellAgain();
  } else if (moved) {
    moved_ = ServingClock::now();
  }
}

void StationLine::take(const Ask& ask) {
  {
    const std::lock_guard lock(mutex_);
    if (std::find(asked_.begin(), asked_.end(), ask.id) != asked_.end()) return;
    asked_.push_back(ask.id);
    if (asked_.size() > kAsksRemembered) asked_.pop_front();
    if (ask.what != Ask::What::stop) {
      if (asks_.size() < kMostAsks) asks_.push_back({ask, ServingClock::now()});
      came_.notify_all();
      return;
    }
  }
  handle(ask);
}

/// What has waited too long behind others is left undone: whoever asked has been told so.
void StationLine::handleAll() {
  os::giveWay();
  std::unique_lock lock(mutex_);
  for (;;) {
    came_.wait(lock, [this] { return ending_ || !asks_.empty(); });
    if (ending_) return;
    const Waiting next = std::move(asks_.front());
    asks_.pop_front();
    if (ServingClock::now() - next.came > kAskIsGood) continue;
    lock.unlock();
    handle(next.ask);
    lock.lock();
  }
}

void StationLine::handle(const Ask& ask) {
  Answer answer{ask.id, false, ""};
  try {
    answer = handles_(ask);
    answer.id = ask.id;
  } catch (const std::exception& e) {
    answer.words = e.what();
  }
  line_.say(said(Topic::answers, toJson(answer), false));
}

void StationLine::hears(const Said& said) {
  const auto addressed = addressedIn(said.topic);
  if (!addressed || addressed->station != station_) return;
  try {
    if (addressed->topic == Topic::heard) hearsOf(heardIn(said.words));
    // What somebody asked for before we were here is not what he asks for now.
    if (addressed->topic == Topic::asks && !said.retained) take(askIn(said.words));
  } catch (const Error&) {  // nobody of this room speaks so
  }
}

}  // namespace palpa::room
