#include "apps/room/nearby.h"

#include <avahi-client/client.h>
#include <avahi-client/lookup.h>
#include <avahi-client/publish.h>
#include <avahi-common/alternative.h>
#include <avahi-common/error.h>
#include <avahi-common/malloc.h>
#include <avahi-common/simple-watch.h>
#include <avahi-common/strlst.h>

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "apps/os/real_time.h"
#include "apps/runtime/clock.h"

namespace palpa::room {
namespace {

constexpr char kService[] = "_palpa._tcp";
constexpr std::chrono::milliseconds kLook{200};
constexpr std::chrono::seconds kAgain{15}, kLeaving{2};
/// Being asked about at a time, and waiting for that: who announces thousands is not heard whole.
constexpr std::size_t kMostAsked = 32, kMostWaiting = 1000;

struct FreedPoll {
  void operator()(AvahiSimplePoll* one) const { avahi_simple_poll_free(one); }
};
/// Takes with it all that was made of it.
struct FreedClient {
  void operator()(AvahiClient* one) const { avahi_client_free(one); }
};
struct FreedTexts {
  void operator()(AvahiStringList* one) const { avahi_string_list_free(one); }
};

std::string networkOf(AvahiIfIndex interface, AvahiProtocol protocol) {
  return std::to_string(interface) + "/" + std::to_string(protocol);
}

}  // namespace

struct Nearby::Shared {
  explicit Shared(Wish wanted) : wish(std::move(wanted)) {}

  const Wish wish;
  mutable std::mutex mutex;
  std::condition_variable changed;
  FoundConsoles found;
  std::string trouble;
  bool ending = false, ended = false;

  // Of its thread alone.
  /// What somebody announces, before it is known what it is.
  struct Announced {
    AvahiIfIndex interface;
    AvahiProtocol protocol;
    std::string name, type, domain;
  };
  AvahiEntryGroup* group = nullptr;
  AvahiServiceBrowser* browser = nullptr;
  std::string name;
  std::deque<Announced> waiting;
  std::size_t asked = 0;
  bool lost = false;

  void run();

 private:
  void speak();
  bool isEnding() const;
  void say(const std::string& words);
  void stands(AvahiClient* client, AvahiClientState state);
  void announce(AvahiClient* client);
  void announced(AvahiEntryGroup* of, AvahiEntryGroupState state);
  void look(AvahiClient* client);
  void askNext(AvahiClient* client);
  void forgetAll();
  static Shared& of(void* self) { return *static_cast<Shared*>(self); }
  static void browsed(AvahiServiceBrowser* browser, AvahiIfIndex interface, AvahiProtocol protocol,
                      AvahiBrowserEvent event, const char* name, const char* type,
                      const char* domain, AvahiLookupResultFlags flags, void* self);
  static void resolved(AvahiServiceResolver* resolver, AvahiIfIndex interface,
                       AvahiProtocol protocol, AvahiResolverEvent event, const char* name,
                       const char* type, const char* domain, const char* host,
                       const AvahiAddress* address, std::uint16_t port, AvahiStringList* txt,
                       AvahiLookupResultFlags flags, void* self);
};

bool Nearby::Shared::isEnding() const {
  const std::lock_guard lock(mutex);
  return ending;
}

void Nearby::Shared::say(const std::string& words) {
  const std::lock_guard lock(mutex);
  trouble = words;
}

void Nearby::Shared::forgetAll() {
  const std::lock_guard lock(mutex);
  found.clear();
}

void Nearby::Shared::announce(AvahiClient* client) {
  if (!wish.announces) return;
  if (!group)
    group = avahi_entry_group_new(
        client,
        [](AvahiEntryGroup* one, AvahiEntryGroupState state, void* self) {
          of(self).announced(one, state);
        },
        this);
  if (!group) return say(avahi_strerror(avahi_client_errno(client)));
  if (name.empty()) {
    const char* const host = avahi_client_get_host_name(client);
    name = std::string("Palpa on ") + (host ? host : "this computer");
  }
  AvahiStringList* list = nullptr;
  for (const std::string& text : txtOf(*wish.announces))
    list = avahi_string_list_add(list, text.c_str());
  const std::unique_ptr<AvahiStringList, FreedTexts> texts(list);
  const auto port = static_cast<std::uint16_t>(wish.announces->port);
  for (int tries = 0; tries < 100; ++tries) {
    const int result = avahi_entry_group_add_service_strlst(
        group, AVAHI_IF_UNSPEC, AVAHI_PROTO_UNSPEC, AvahiPublishFlags{}, name.c_str(), kService,
        nullptr, nullptr, port, texts.get());
    if (result != AVAHI_ERR_COLLISION) {
      const int done = result == AVAHI_OK ? avahi_entry_group_commit(group) : result;
      if (done != AVAHI_OK)
        say(std::string("This console is not announced: ") + avahi_strerror(done));
      return;
    }
    char* const other = avahi_alternative_service_name(name.c_str());
    name = other;
    avahi_free(other);
    avahi_entry_group_reset(group);
  }
}

void Nearby::Shared::announced(AvahiEntryGroup* one, AvahiEntryGroupState state) {
  if (state != AVAHI_ENTRY_GROUP_COLLISION) return;
  char* const other = avahi_alternative_service_name(name.c_str());  // another computer's
  name = other;
  avahi_free(other);
  group = one;
  avahi_entry_group_reset(one);
  announce(avahi_entry_group_get_client(one));
}

void Nearby::Shared::look(AvahiClient* client) {
  if (!wish.looks || browser) return;
  browser = avahi_service_browser_new(client, AVAHI_IF_UNSPEC, AVAHI_PROTO_UNSPEC, kService,
                                      nullptr, AvahiLookupFlags{}, browsed, this);
  if (!browser) say(avahi_strerror(avahi_client_errno(client)));
}

void Nearby::Shared::browsed(AvahiServiceBrowser* browser, AvahiIfIndex interface,
                             AvahiProtocol protocol, AvahiBrowserEvent event, const char* name,
                             const char* type, const char* domain, AvahiLookupResultFlags flags,
                             void* self) {
  Shared& me = of(self);
  if (event == AVAHI_BROWSER_FAILURE) me.lost = true;
  if (event == AVAHI_BROWSER_REMOVE && name) {
    const std::lock_guard lock(me.mutex);
    me.found.remove(networkOf(interface, protocol), name);
  }
  if (event != AVAHI_BROWSER_NEW || !name || (flags & AVAHI_LOOKUP_RESULT_OUR_OWN)) return;
  if (me.waiting.size() == kMostWaiting) return;
  me.waiting.push_back({interface, protocol, name, type, domain});
  me.askNext(avahi_service_browser_get_client(browser));
}

void Nearby::Shared::askNext(AvahiClient* client) {
  const auto hasRoom = [this] {
    const std::lock_guard lock(mutex);
    return !found.isFull();
  };
  while (!waiting.empty() && asked < kMostAsked && hasRoom()) {
    const Announced next = std::move(waiting.front());
    waiting.pop_front();
    if (avahi_service_resolver_new(client, next.interface, next.protocol, next.name.c_str(),
                                   next.type.c_str(), next.domain.c_str(), AVAHI_PROTO_UNSPEC,
                                   AvahiLookupFlags{}, resolved, this))
      ++asked;
  }
}

void Nearby::Shared::resolved(AvahiServiceResolver* resolver, AvahiIfIndex interface,
                              AvahiProtocol protocol, AvahiResolverEvent event, const char* name,
                              const char*, const char*, const char* host, const AvahiAddress*,
                              std::uint16_t port, AvahiStringList* txt, AvahiLookupResultFlags,
                              void* self) {
  Shared& me = of(self);
  if (event == AVAHI_RESOLVER_FOUND && name && host) {
    TxtOfService service{name, host, port, {}};
    for (AvahiStringList* one = txt; one; one = avahi_string_list_get_next(one))
      service.txt.emplace_back(reinterpret_cast<const char*>(avahi_string_list_get_text(one)),
                               avahi_string_list_get_size(one));
    if (const auto console = consoleIn(service)) {
      const std::lock_guard lock(me.mutex);
      me.found.add(networkOf(interface, protocol), *console);
    }
  }
  AvahiClient* const client = avahi_service_resolver_get_client(resolver);
  avahi_service_resolver_free(resolver);
  --me.asked;
  me.askNext(client);
}

void Nearby::Shared::stands(AvahiClient* client, AvahiClientState state) {
  switch (state) {
    case AVAHI_CLIENT_S_RUNNING:
      say("");
      announce(client);
      look(client);
      break;
    case AVAHI_CLIENT_S_COLLISION:
    case AVAHI_CLIENT_S_REGISTERING:
      if (group) avahi_entry_group_reset(group);
      break;
    case AVAHI_CLIENT_FAILURE:
      lost = true;
      break;
    case AVAHI_CLIENT_CONNECTING:
      break;
  }
}

/// Until the daemon is gone, or we go.
void Nearby::Shared::speak() {
  const std::unique_ptr<AvahiSimplePoll, FreedPoll> poll(avahi_simple_poll_new());
  if (!poll) return;
  int error = 0;
  const std::unique_ptr<AvahiClient, FreedClient> client(avahi_client_new(
      avahi_simple_poll_get(poll.get()), AvahiClientFlags{},
      [](AvahiClient* one, AvahiClientState state, void* self) { of(self).stands(one, state); },
      this, &error));
  while (client && !lost && !isEnding())
    if (avahi_simple_poll_iterate(poll.get(), static_cast<int>(kLook.count())) != 0) break;
  group = nullptr;  // gone with the client
  browser = nullptr;
  waiting.clear();
  asked = 0;
}

void Nearby::Shared::run() {
  os::giveWay();
  for (;;) {
    lost = false;
    speak();
    forgetAll();
    std::unique_lock lock(mutex);
    if (ending) break;
    trouble =
        "Consoles on this network do not find each other by themselves: avahi-daemon does not "
        "answer (Debian: apt install avahi-daemon)";
    if (changed.wait_for(lock, kAgain, [this] { return ending; })) break;
  }
  const std::lock_guard lock(mutex);
  ended = true;
  changed.notify_all();
}

Nearby::Nearby(const Wish& wish) : shared_(std::make_shared<Shared>(wish)) {
  os::startThread([shared = shared_] { shared->run(); }).detach();
}

/// Who hangs in a call to the daemon is left behind.
Nearby::~Nearby() {
  std::unique_lock lock(shared_->mutex);
  shared_->ending = true;
  shared_->changed.notify_all();
  shared_->changed.wait_for(lock, kLeaving, [this] { return shared_->ended; });
}

std::vector<FoundConsole> Nearby::found() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->found.all();
}

std::string Nearby::trouble() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->trouble;
}

}  // namespace palpa::room
