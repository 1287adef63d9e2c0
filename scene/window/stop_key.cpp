#include "scene/window/stop_key.h"

#include <xcb/xcb.h>

#include <cstdint>
#include <set>

#include "scene/window/x11_server.h"

namespace palpa::scene {
namespace {

constexpr xcb_keysym_t kSpace = 0x20;

/// The keys that give a space.
std::set<xcb_keycode_t> spaceKeys(xcb_connection_t* server) {
  const xcb_setup_t* const setup = xcb_get_setup(server);
  const auto first = setup->min_keycode;
  const auto count = static_cast<std::uint8_t>(setup->max_keycode - first + 1);
  const XcbAnswer<xcb_get_keyboard_mapping_reply_t> mapping(xcb_get_keyboard_mapping_reply(
      server, xcb_get_keyboard_mapping(server, first, count), nullptr));
  std::set<xcb_keycode_t> keys;
  if (!mapping) return keys;
  const xcb_keysym_t* const symbols = xcb_get_keyboard_mapping_keysyms(mapping.get());
  const int length = xcb_get_keyboard_mapping_keysyms_length(mapping.get());
  for (int i = 0; i < length; ++i)
    if (symbols[i] == kSpace)
      keys.insert(static_cast<xcb_keycode_t>(first + i / mapping->keysyms_per_keycode));
  return keys;
}

}  // namespace

struct StopKey::Connection {
  xcb_connection_t* server = xcb_connect(nullptr, nullptr);  // never null: it has an error then
  std::set<xcb_keycode_t> keys;

  ~Connection() { xcb_disconnect(server); }
  bool lost() const { return xcb_connection_has_error(server) != 0; }
};

StopKey::StopKey(unsigned long window) : connection_(std::make_unique<Connection>()) {
  if (connection_->lost()) return;
  connection_->keys = spaceKeys(connection_->server);
  const std::uint32_t events = XCB_EVENT_MASK_KEY_PRESS;
  xcb_change_window_attributes(connection_->server, static_cast<xcb_window_t>(window),
                               XCB_CW_EVENT_MASK, &events);
  xcb_flush(connection_->server);
}

StopKey::~StopKey() = default;

int StopKey::descriptor() const {
  return connection_->lost() ? -1 : xcb_get_file_descriptor(connection_->server);
}

bool StopKey::pressed() {
  bool pressed = false;
  while (true) {
    const XcbAnswer<xcb_generic_event_t> event(xcb_poll_for_event(connection_->server));
    if (!event) return pressed;
    if ((event->response_type & ~kFromAnotherProgram) != XCB_KEY_PRESS) continue;
    const auto* key = reinterpret_cast<const xcb_key_press_event_t*>(event.get());
    pressed |= connection_->keys.count(key->detail) > 0;
  }
}

}  // namespace palpa::scene
