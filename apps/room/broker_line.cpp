#include "apps/room/broker_line.h"

#include <mosquitto.h>
#include <mqtt_protocol.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "anatomy/base/error.h"
#include "apps/os/real_time.h"
#include "apps/os/socket.h"
#include "apps/os/tls/tls_client.h"
#include "apps/room/broker_words.h"
#include "apps/runtime/clock.h"

namespace palpa::room {
namespace {

using std::chrono::milliseconds;
constexpr int kQos = 1, kKeepAlive = 10;  // s
constexpr std::size_t kUnderWay = 20;     // said and not taken yet
constexpr milliseconds kStep{100}, kFirstRest{1000}, kLongestRest{15000}, kEnding{2000};

/// Once a program, never undone.
void beginLibrary() {
  static const int begun = mosquitto_lib_init();
  if (begun != MOSQ_ERR_SUCCESS)
    throw Error("cannot be used", "the MQTT library", "Install libmosquitto1 anew");
  os::surviveBrokenConnections();
}

using Client = std::unique_ptr<mosquitto, decltype([](mosquitto* it) { mosquitto_destroy(it); })>;

}  // namespace

/// What is to be said, until when.
struct BrokerLine::Waiting {
  explicit Waiting(Said what)
      : said(std::move(what)),
        until(said.good_for ? runtime::ServingClock::now() + *said.good_for
                            : runtime::ServingClock::time_point::max()) {}
  bool isOver() const { return runtime::ServingClock::now() > until; }
  Said said;
  runtime::ServingClock::time_point until;
};

struct BrokerLine::Shared {
  explicit Shared(Wish wanted)
      : wish(std::move(wanted)),
        tls({wish.access.authority, wish.access.host, wish.access.identity}) {}

  const Wish wish;
  const os::TlsClient tls;

  mutable std::mutex mutex;
  std::condition_variable changed;
  std::deque<Waiting> waiting;
  State state;
  bool ending = false, ended = false;

  // Of the line's thread alone.
  std::deque<std::pair<int, Waiting>> under_way;  ///< with the library's numbers
  bool open = false, greeted = false;
  runtime::ServingClock::time_point opened_at{};
  int brief = 0;  ///< lines in a row that were lost soon after they stood
  std::string log, refused;

  /// Held while somebody is told something; nobody is, once `deaf`: they may be gone.
  std::mutex telling;
  bool deaf = false;

  void run();

 private:
  Client connecting();
  int speak(mosquitto* client);
  void send(mosquitto* client);
  bool say(mosquitto* client, Waiting one);
  void settle(bool stands, const std::string& trouble);
  bool done();
  void takeBack();

  static Shared& of(void* self) { return *static_cast<Shared*>(self); }
  void hello(int reason);
  void greet(mosquitto* client);
  void listens(const std::vector<int>& reasons);
  void countBriefLines();
  void hear(const mosquitto_message& message);
  void taken(int number, int reason);
};

/// Of what waits the newest retained words of a topic count.
template <class Queue>
static void forgetOlder(Queue* waiting, const Said& newer) {
  if (!newer.retained) return;
  std::erase_if(*waiting, [&](const auto& one) {
    return one.said.retained && one.said.topic == newer.topic;
  });
}

template <class Queue, class One>
static void keepInOrder(Queue* waiting, One one) {
  forgetOlder(waiting, one.said);
  if (waiting->size() == BrokerLine::kMostWaiting) waiting->pop_front();
  const auto behind = one.said.urgent
                          ? std::find_if(waiting->begin(), waiting->end(),
                                         [](const auto& other) { return !other.said.urgent; })
                          : waiting->end();
  waiting->insert(behind, std::move(one));
}

void BrokerLine::Shared::settle(bool stands, const std::string& trouble) {
  const std::lock_guard lock(mutex);
  state = {stands, trouble};
}

/// The broker has taken us, or says why not.
void BrokerLine::Shared::hello(int reason) {
  open = reason == 0;
  opened_at = runtime::ServingClock::now();
  if (!open)
    refused = whyRefused(reason);
  else if (wish.topics.empty())
    settle(true, "");
}

/// From here on nothing of our topics passes us by, or the broker says why not.
void BrokerLine::Shared::listens(const std::vector<int>& reasons) {
  const auto bad = std::find_if(reasons.begin(), reasons.end(), isRefusal);
  if (bad == reasons.end()) return settle(true, "");
  refused = whyNotTold(*bad);
}

/// Not within the library's call: it holds locks of its own there.
void BrokerLine::Shared::greet(mosquitto* client) {
  greeted = true;
  std::vector<char*> topics;  // the library changes none of them
  for (const std::string& topic : wish.topics) topics.push_back(const_cast<char*>(topic.c_str()));
  if (!topics.empty())
    mosquitto_subscribe_multiple(client, nullptr, static_cast<int>(topics.size()), topics.data(),
                                 kQos, 0, nullptr);
  std::vector<Said> greeting;
  {
    const std::lock_guard lock(telling);
    if (!deaf && wish.greets) greeting = wish.greets();
  }
  for (Said& said : greeting) {
    {
      const std::lock_guard lock(mutex);
      forgetOlder(&waiting, said);
    }
    say(client, Waiting(std::move(said)));
  }
}

/// Who shares a name with somebody is thrown out as soon as the other one comes back.
void BrokerLine::Shared::countBriefLines() {
  constexpr std::chrono::seconds kBrief{10};
  constexpr int kMostBrief = 2;
  const bool was_brief = open && runtime::ServingClock::now() - opened_at < kBrief;
  brief = was_brief ? brief + 1 : 0;
  if (brief > kMostBrief && refused.empty()) refused = kEndsEveryLine;
}

void BrokerLine::Shared::hear(const mosquitto_message& message) {
  const std::lock_guard lock(telling);
  if (deaf || !wish.hears || message.payloadlen < 0) return;
  wish.hears(
      {message.topic,
       {static_cast<const char*>(message.payload), static_cast<std::size_t>(message.payloadlen)},
       message.retain});
}

void BrokerLine::Shared::taken(int number, int reason) {
  const auto found = std::find_if(under_way.begin(), under_way.end(),
                                  [number](const auto& one) { return one.first == number; });
  if (found == under_way.end()) return;
  if (isRefusal(reason)) refused = whyNotHeard(found->second.said.topic, reason);
  under_way.erase(found);
}

Client BrokerLine::Shared::connecting() {
  Client client(mosquitto_new(nullptr, true, this));
  if (!client) throw Error("has no memory left", "the line to the room's broker", "Close programs");
  mosquitto* const one = client.get();
  mosquitto_int_option(one, MOSQ_OPT_PROTOCOL_VERSION, MQTT_PROTOCOL_V5);
  mosquitto_int_option(one, MOSQ_OPT_TCP_NODELAY, 1);
  mosquitto_int_option(one, MOSQ_OPT_SSL_CTX_WITH_DEFAULTS, 0);
  mosquitto_void_option(one, MOSQ_OPT_SSL_CTX, tls.context());
  if (const Said& will = wish.last_will; !will.topic.empty())
    mosquitto_will_set_v5(one, will.topic.c_str(), static_cast<int>(will.words.size()),
                          will.words.data(), kQos, will.retained, nullptr);
  mosquitto_connect_v5_callback_set(one, [](mosquitto*, void* self, int reason, int,
                                            const mosquitto_property*) { of(self).hello(reason); });
  mosquitto_publish_v5_callback_set(
      one, [](mosquitto*, void* self, int number, int reason, const mosquitto_property*) {
        of(self).taken(number, reason);
      });
  mosquitto_subscribe_v5_callback_set(one, [](mosquitto*, void* self, int, int count,
                                              const int* reasons, const mosquitto_property*) {
    of(self).listens({reasons, reasons + count});
  });
  mosquitto_message_v5_callback_set(
      one, [](mosquitto*, void* self, const mosquitto_message* message, const mosquitto_property*) {
        of(self).hear(*message);
      });
  mosquitto_log_callback_set(one, [](mosquitto*, void* self, int level, const char* words) {
    if (level == MOSQ_LOG_ERR) of(self).log = words;
  });
  return client;
}

/// False: it is to be said later. What can never be said is forgotten, with a word.
bool BrokerLine::Shared::say(mosquitto* client, Waiting one) {
  const Said& said = one.said;
  mosquitto_property* more = nullptr;
  if (said.good_for)
    mosquitto_property_add_int32(&more, MQTT_PROP_MESSAGE_EXPIRY_INTERVAL,
                                 static_cast<std::uint32_t>(said.good_for->count()));
  int number = 0;
  const int result =
      mosquitto_publish_v5(client, &number, said.topic.c_str(), static_cast<int>(said.words.size()),
                           said.words.data(), kQos, said.retained, more);
  mosquitto_property_free_all(&more);
  const bool never = result == MOSQ_ERR_OVERSIZE_PACKET || result == MOSQ_ERR_PAYLOAD_SIZE ||
                     result == MOSQ_ERR_INVAL || result == MOSQ_ERR_MALFORMED_UTF8;
  if (never) settle(true, tooMuch(said.topic, result));
  if (result == MOSQ_ERR_SUCCESS) under_way.emplace_back(number, std::move(one));
  return never || result == MOSQ_ERR_SUCCESS;
}

void BrokerLine::Shared::send(mosquitto* client) {
  while (open) {
    std::optional<Waiting> next;
    {
      const std::lock_guard lock(mutex);
      while (!waiting.empty() && waiting.front().isOver()) waiting.pop_front();
      if (waiting.empty()) return;
      if (under_way.size() >= kUnderWay && !waiting.front().said.urgent) return;
      next = std::move(waiting.front());
      waiting.pop_front();
    }
    if (say(client, *next)) continue;
    const std::lock_guard lock(mutex);
    waiting.push_front(std::move(*next));
    return;
  }
}

/// Nothing is left to be said, and we are asked to go.
bool BrokerLine::Shared::done() {
  const std::lock_guard lock(mutex);
  return ending && ((waiting.empty() && under_way.empty()) || !open);
}

/// Until the line is lost, or we go. The library's word why.
int BrokerLine::Shared::speak(mosquitto* client) {
  int result = MOSQ_ERR_SUCCESS;
  while (result == MOSQ_ERR_SUCCESS && refused.empty()) {
    if (open && !greeted) greet(client);
    send(client);
    if (done()) {
      mosquitto_disconnect_v5(client, 0, nullptr);
      mosquitto_loop(client, static_cast<int>(kStep.count()), 1);
      return MOSQ_ERR_SUCCESS;
    }
    result = mosquitto_loop(client, static_cast<int>(kStep.count()), 1);
  }
  return result;
}

/// What the broker has not taken is said again, before the rest.
void BrokerLine::Shared::takeBack() {
  const std::lock_guard lock(mutex);
  std::deque<Waiting> again;
  for (auto& [number, one] : under_way) keepInOrder(&again, std::move(one));
  for (Waiting& one : waiting) keepInOrder(&again, std::move(one));
  waiting = std::move(again);
  under_way.clear();
}

void BrokerLine::Shared::run() {
  os::giveWay();
  milliseconds rest = kFirstRest;
  for (;;) {
    open = greeted = false;
    log.clear();
    refused.clear();
    const Client client = connecting();
    int result = mosquitto_connect_bind_v5(client.get(), wish.access.host.c_str(), wish.access.port,
                                           kKeepAlive, nullptr, nullptr);
    if (result == MOSQ_ERR_SUCCESS) {
      result = speak(client.get());
      // Its word why may be lost with the line, on which we have begun to talk meanwhile.
      if (!open && refused.empty() && !isAnotherRooms(log)) refused = kNotOurs;
    }
    countBriefLines();
    rest = open && refused.empty() ? kFirstRest : std::min(2 * rest, kLongestRest);
    takeBack();
    std::unique_lock lock(mutex);
    if (ending) break;
    state = {false, ofBroker(wish.access, refused.empty() ? whyNot(result, log) : refused)};
    if (changed.wait_for(lock, rest, [this] { return ending; })) break;
  }
  const std::lock_guard lock(mutex);
  state = {};
  ended = true;
  changed.notify_all();
}

BrokerLine::BrokerLine(Wish wish) : shared_(std::make_shared<Shared>(std::move(wish))) {
  beginLibrary();
  os::startThread([shared = shared_] {
    try {
      shared->run();
    } catch (const std::exception& e) {
      const std::lock_guard lock(shared->mutex);
      shared->state = {false, e.what()};
      shared->ended = true;
      shared->changed.notify_all();
    }
  }).detach();
}

BrokerLine::~BrokerLine() {
  {
    const std::lock_guard lock(shared_->telling);
    shared_->deaf = true;
  }
  std::unique_lock lock(shared_->mutex);
  shared_->ending = true;
  shared_->changed.notify_all();
  shared_->changed.wait_for(lock, kEnding, [this] { return shared_->ended; });
}

void BrokerLine::say(Said said) {
  const std::lock_guard lock(shared_->mutex);
  keepInOrder(&shared_->waiting, Waiting(std::move(said)));
}

BrokerLine::State BrokerLine::state() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->state;
}

}  // namespace palpa::room
