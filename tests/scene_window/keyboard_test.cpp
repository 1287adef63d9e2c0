#include "scene/window/keyboard.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include "scene/scene_state.h"
// X11's headers define macros with everyday names: after all others.
#include <X11/Xlib.h>

/// Real X events by a key's number (xdotool), in the layouts that setxkbmap puts on, on a display
/// of our own (Xvfb).
namespace palpa::scene {
namespace {

/// A window with the mouse over it: without a window manager it has the keys.
class KeysOfALayout : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::getenv("DISPLAY")) GTEST_SKIP() << "no DISPLAY: run under xvfb-run";
    for (const char* tool : {"xdotool version", "setxkbmap -version"})
      if (std::system((std::string(tool) + " > /dev/null 2>&1").c_str()) != 0)
        GTEST_SKIP() << "not installed: " << tool;
    display_ = XOpenDisplay(nullptr);
    ASSERT_TRUE(display_);
    window_ = XCreateSimpleWindow(display_, DefaultRootWindow(display_), 0, 0, 300, 200, 0, 0, 0);
    XMapRaised(display_, window_);
    XWarpPointer(display_, 0, window_, 0, 0, 0, 0, 100, 100);
    XSync(display_, False);
  }
  void TearDown() override {
    if (!display_) return;
    XDestroyWindow(display_, window_);
    XCloseDisplay(display_);
    putOn("us");
  }
  static void putOn(const std::string& layout) {
    ASSERT_EQ(std::system(("setxkbmap " + layout).c_str()), 0);
  }
  static void press(const std::string& keys) {
    ASSERT_EQ(std::system(("xdotool key " + keys).c_str()), 0);
  }
  static std::vector<PressedKey> heard(Keyboard& keyboard, std::size_t enough) {
    std::vector<PressedKey> all;
    for (int i = 0; i < 100 && all.size() < enough; ++i) {
      for (PressedKey& key : keyboard.pressed()) all.push_back(key);
      EXPECT_EQ(std::system("sleep 0.01"), 0);
    }
    return all;
  }

  ::Display* display_ = nullptr;
  ::Window window_ = 0;
};

// Where X has T, Z, A, M and 6 of a US keyboard.
constexpr const char* kPressed = "28 52 38 58 15";

struct Layout {
  const char* name;
  std::vector<std::string> typed;  ///< of kPressed
  KeyPrints prints;                ///< where they are others than on a US keyboard
};

const std::vector<Layout> kLayouts = {
    {"us", {"t", "z", "a", "m", "6"}, {}},
    {"gr",
     {"Greek_tau", "Greek_zeta", "Greek_alpha", "Greek_mu", "6"},
     {{'T', "Τ"}, {'Z', "Ζ"}, {'A', "Α"}, {'M', "Μ"}}},
    {"ru",
     {"Cyrillic_ie", "Cyrillic_ya", "Cyrillic_ef", "Cyrillic_softsign", "6"},
     {{'T', "Е"}, {'Z', "Я"}, {'A', "Ф"}, {'M', "Ь"}}},
    {"fr", {"t", "w", "q", "comma", "minus"}, {{'Z', "W"}, {'A', "Q"}, {'M', "“,”"}}},
    {"kr", {"t", "z", "a", "m", "6"}, {}},
};

TEST_F(KeysOfALayout, AreKnownByTheirPlaceAndShownAsTheyArePrinted) {
  for (const Layout& layout : kLayouts) {
    SCOPED_TRACE(layout.name);
    putOn(layout.name);
    Keyboard keyboard(window_);
    press(kPressed);
    const std::vector<PressedKey> keys = heard(keyboard, 5);
    ASSERT_EQ(keys.size(), 5u);
    const char* const names[] = {"t", "z", "a", "m", "6"};
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(keys[i].name, names[i]);
      EXPECT_EQ(keys[i].typed, layout.typed[i]);
    }
    for (const char us : {'T', 'Z', 'A', 'M'}) {
      const auto want = layout.prints.find(us);
      EXPECT_EQ(withKeys(std::string("[") + us + "]", keyboard.prints()),
                want == layout.prints.end() ? std::string(1, us) : want->second);
    }
  }
}

TEST_F(KeysOfALayout, FollowASwitchWhileTheWindowIsOpen) {
  putOn("us");
  Keyboard keyboard(window_);
  press("28");
  ASSERT_EQ(heard(keyboard, 1).size(), 1u);
  EXPECT_EQ(withKeys("[A] ends the trial", keyboard.prints()), "A ends the trial");
  putOn("fr");
  EXPECT_TRUE(heard(keyboard, 1).empty());
  EXPECT_EQ(withKeys("[A] ends the trial", keyboard.prints()), "Q ends the trial");
  press("38");
  const std::vector<PressedKey> keys = heard(keyboard, 1);
  ASSERT_EQ(keys.size(), 1u);
  EXPECT_EQ(keys[0].name, "a");
}

/// A held Shift or Caps Lock makes no other key of it, and other keys go by what they type.
TEST_F(KeysOfALayout, OfTheRestAreKnownByWhatTheyType) {
  putOn("us");
  Keyboard keyboard(window_);
  press("shift+28 shift+question Escape F11 Left space Return");
  std::vector<std::string> names;
  for (const PressedKey& key : heard(keyboard, 9))
    if (!key.name.starts_with("Shift") && !key.name.starts_with("shift")) names.push_back(key.name);
  EXPECT_EQ(names, (std::vector<std::string>{"t", "question", "Escape", "F11", "Left", "space",
                                             "Return"}));
}

TEST(KeyPlaces, TextsNameAKeyByItsUsLetter) {
  const KeyPrints french{{'A', "Q"}, {'M', "“,”"}};
  EXPECT_EQ(withKeys("Enter continues, [A] ends", french), "Enter continues, Q ends");
  EXPECT_EQ(withKeys("[M] marks, [.] draws", french), "“,” marks, “.” draws");
  EXPECT_EQ(withKeys("[P] pauses", {}), "P pauses");
  EXPECT_EQ(withKeys("a [word], [a], []", french), "a [word], [a], []");
  Hud hud;
  hud.can_do = "[A] ends";
  hud.notice = "[M] marks";
  EXPECT_EQ(withKeys(hud, french).can_do, "Q ends");
  EXPECT_EQ(withKeys(hud, french).notice, "“,” marks");
}

TEST(KeyPlaces, HaveNamesThatDiffer) {
  std::set<std::string> names, places;
  for (const KeyPlace& place : keyPlaces()) {
    EXPECT_EQ(keyPlaceOf(place.xkb.data()), &place);
    names.insert(place.name);
    places.insert(place.xkb.data());
  }
  EXPECT_EQ(names.size(), keyPlaces().size());
  EXPECT_EQ(places.size(), keyPlaces().size());
  EXPECT_EQ(keyPlaceOf("SPCE"), nullptr);
}

}  // namespace
}  // namespace palpa::scene
