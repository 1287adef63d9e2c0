#include "scene/window/keyboard.h"

#include <xcb/xcb.h>
#include <xkbcommon/xkbcommon-x11.h>
#include <xkbcommon/xkbcommon.h>

#include <array>
#include <cctype>
#include <cstdint>
#include <utility>

#include "anatomy/base/fonts.h"
#include "scene/window/x11_server.h"
// A field of its is called explicit.
#define explicit is_explicit
#include <xcb/xkb.h>
#undef explicit

namespace palpa::scene {
namespace {

using XkbContext = std::unique_ptr<xkb_context, decltype([](auto* it) { xkb_context_unref(it); })>;
using XkbKeymap = std::unique_ptr<xkb_keymap, decltype([](auto* it) { xkb_keymap_unref(it); })>;
using XkbState = std::unique_ptr<xkb_state, decltype([](auto* it) { xkb_state_unref(it); })>;

std::string symbolName(xkb_keysym_t symbol) {
  std::array<char, 64> name{};
  return xkb_keysym_get_name(symbol, name.data(), name.size()) > 0 ? name.data() : "";
}

/// As it stands on the key; empty: nothing that could be drawn does.
std::string printedAs(xkb_keysym_t symbol) {
  const xkb_keysym_t large = xkb_keysym_to_upper(symbol);
  const std::uint32_t letter = xkb_keysym_to_utf32(large);
  if (letter <= 0x20 || !hasFont(letter)) return "";
  std::array<char, 8> text{};
  xkb_keysym_to_utf8(large, text.data(), text.size());
  const bool sign = letter < 0x80 ? std::isalnum(static_cast<int>(letter)) == 0 : letter < 0xc0;
  return sign ? std::string("“") + text.data() + "”" : std::string(text.data());
}

/// The layout that the server has now, of all keyboards together.
struct Layout {
  XkbKeymap keymap;
  XkbState state;  ///< for questions: set before each
  xkb_layout_index_t group = 0;

  const KeyPlace* placeOf(xkb_keycode_t key) const {
    const char* const name = keymap ? xkb_keymap_key_get_name(keymap.get(), key) : nullptr;
    return name ? keyPlaceOf(name) : nullptr;
  }
  /// `modifiers`: the core protocol's eight.
  xkb_keysym_t symbolOf(xkb_keycode_t key, std::uint32_t modifiers, xkb_layout_index_t of) const {
    if (!state) return XKB_KEY_NoSymbol;
    xkb_state_update_mask(state.get(), modifiers, 0, 0, 0, 0, of);
    return xkb_state_key_get_one_sym(state.get(), key);
  }
};

Layout layoutOf(xkb_context* context, xcb_connection_t* server) {
  Layout layout;
  const std::int32_t device = xkb_x11_get_core_keyboard_device_id(server);
  if (device < 0) return layout;
  layout.keymap.reset(
      xkb_x11_keymap_new_from_device(context, server, device, XKB_KEYMAP_COMPILE_NO_FLAGS));
  if (!layout.keymap) return layout;
  const XkbState now(xkb_x11_state_new_from_device(layout.keymap.get(), server, device));
  if (now) layout.group = xkb_state_serialize_layout(now.get(), XKB_STATE_LAYOUT_EFFECTIVE);
  layout.state.reset(xkb_state_new(layout.keymap.get()));
  return layout;
}

KeyPrints printsOf(const Layout& layout) {
  KeyPrints prints;
  if (!layout.keymap) return prints;
  const xkb_keycode_t last = xkb_keymap_max_keycode(layout.keymap.get());
  for (xkb_keycode_t key = xkb_keymap_min_keycode(layout.keymap.get()); key <= last; ++key) {
    const KeyPlace* const place = layout.placeOf(key);
    // Digits stand on the keys of every layout, if not always as what comes without Shift.
    if (!place || std::isdigit(static_cast<unsigned char>(place->us))) continue;
    const std::string print = printedAs(layout.symbolOf(key, 0, layout.group));
    if (!print.empty()) prints[place->us] = print;
  }
  return prints;
}

PressedKey pressOf(const Layout& layout, const xcb_key_press_event_t& key) {
  constexpr std::uint32_t kModifiers = 0xff, kGroupBit = 13, kGroups = 3;
  const xkb_keysym_t symbol =
      layout.symbolOf(key.detail, key.state & kModifiers, key.state >> kGroupBit & kGroups);
  PressedKey press{.name = symbolName(symbol), .typed = symbolName(symbol)};
  // A hint says "?", which every layout has, and no two at the same place.
  if (symbol == XKB_KEY_question) return press;
  if (const KeyPlace* const place = layout.placeOf(key.detail)) press.name = place->name;
  // From a keyboard on the screen, or from afar: on a key that has no place.
  else if (symbol != xkb_keysym_to_lower(symbol))
    press.name = symbolName(xkb_keysym_to_lower(symbol));
  return press;
}

}  // namespace

struct Keyboard::Connection {
  xcb_connection_t* server = xcb_connect(nullptr, nullptr);  // never null: it has an error then
  XkbContext context{xkb_context_new(XKB_CONTEXT_NO_FLAGS)};
  std::uint8_t first_event = 0;  ///< of XKB; 0: the server has none
  Layout layout;
  KeyPrints prints;

  ~Connection() { xcb_disconnect(server); }
  bool lost() const { return xcb_connection_has_error(server) != 0; }
  void listen(unsigned long window);
  bool note(const xcb_generic_event_t& event, std::vector<PressedKey>& all);
  void read() {
    layout = layoutOf(context.get(), server);
    prints = printsOf(layout);
  }
};

void Keyboard::Connection::listen(unsigned long window) {
  const std::uint32_t keys = XCB_EVENT_MASK_KEY_PRESS;
  xcb_change_window_attributes(server, static_cast<xcb_window_t>(window), XCB_CW_EVENT_MASK, &keys);
  xkb_x11_setup_xkb_extension(server, XKB_X11_MIN_MAJOR_XKB_VERSION, XKB_X11_MIN_MINOR_XKB_VERSION,
                              XKB_X11_SETUP_XKB_EXTENSION_NO_FLAGS, nullptr, nullptr, &first_event,
                              nullptr);
  constexpr std::uint16_t kEvents = XCB_XKB_EVENT_TYPE_NEW_KEYBOARD_NOTIFY |
                                    XCB_XKB_EVENT_TYPE_MAP_NOTIFY | XCB_XKB_EVENT_TYPE_STATE_NOTIFY;
  constexpr std::uint16_t kMaps = XCB_XKB_MAP_PART_KEY_TYPES | XCB_XKB_MAP_PART_KEY_SYMS;
  xcb_xkb_select_events_details_t which{};
  which.affectNewKeyboard = which.newKeyboardDetails = XCB_XKB_NKN_DETAIL_KEYCODES;
  which.affectState = which.stateDetails = XCB_XKB_STATE_PART_GROUP_STATE;
  xcb_xkb_select_events_aux(server, XCB_XKB_ID_USE_CORE_KBD, kEvents, 0, 0, kMaps, kMaps, &which);
  xcb_flush(server);
  read();
}

/// Whether it tells of another layout.
bool Keyboard::Connection::note(const xcb_generic_event_t& event, std::vector<PressedKey>& all) {
  const auto type = static_cast<std::uint8_t>(event.response_type & ~kFromAnotherProgram);
  if (type == XCB_KEY_PRESS)
    all.push_back(pressOf(layout, reinterpret_cast<const xcb_key_press_event_t&>(event)));
  return type == XCB_MAPPING_NOTIFY || (first_event != 0 && type == first_event);
}

Keyboard::Keyboard(unsigned long window) : connection_(std::make_unique<Connection>()) {
  if (!connection_->lost()) connection_->listen(window);
}

Keyboard::~Keyboard() = default;

std::vector<PressedKey> Keyboard::pressed() {
  std::vector<PressedKey> all;
  bool switched = false;
  while (const XcbAnswer<xcb_generic_event_t> event{xcb_poll_for_event(connection_->server)})
    switched |= connection_->note(*event, all);
  if (switched) connection_->read();
  return all;
}

const KeyPrints& Keyboard::prints() const { return connection_->prints; }

}  // namespace palpa::scene
