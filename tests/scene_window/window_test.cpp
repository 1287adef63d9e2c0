#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>

#include "anatomy/base/error.h"
#include "scene/view/scene_view.h"
#include "scene/window/x11_window.h"
#include "tests/support/simple_patient.h"
// X11's headers define macros with everyday names: after all others.
#include <X11/Xatom.h>
#include <X11/Xlib.h>

/// A person at the window, played by xdotool (real X events) on a display of our own (Xvfb).
namespace palpa::scene {
namespace {

constexpr const char* kTitle = "Palpa window test";

class Window : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!std::getenv("DISPLAY")) return;
    context_ = makeGlContext(Display::automatic, 640, 480, kTitle).release();
  }
  static void TearDownTestSuite() {
    delete context_;
    context_ = nullptr;
  }
  void SetUp() override {
    if (!context_) GTEST_SKIP() << "no DISPLAY: run under xvfb-run";
    if (std::system("xdotool version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no xdotool";
  }
  static bool person(const std::string& does) {
    return std::system(("xdotool " + does).c_str()) == 0;
  }
  /// The mouse goes there in the first window.
  static bool mouse(int x, int y) {
    return person("mousemove --window $(xdotool search --name '" + std::string(kTitle) +
                  "' | head -1) " + std::to_string(x) + " " + std::to_string(y));
  }
  /// Polls until `enough`, at most some hundred frames: events take their time through the server.
  template <class Enough>
  ViewInput pollUntil(SceneView& view, Enough enough) {
    ViewInput all;
    for (int i = 0; i < 300; ++i) {
      const ViewInput now = view.poll();
      std::vector<std::string> keys = std::move(all.keys);
      keys.insert(keys.end(), now.keys.begin(), now.keys.end());
      const double wheel = all.wheel + now.wheel;
      all = now;
      all.keys = std::move(keys);
      all.wheel = wheel;
      if (enough(all)) break;
      EXPECT_EQ(std::system("sleep 0.01"), 0);
    }
    return all;
  }

  static GlContextProvider* context_;
  const anatomy::Patient patient_ = test::simplePatient();
};
GlContextProvider* Window::context_ = nullptr;

TEST_F(Window, OpensAndShowsTheScene) {
  EXPECT_TRUE(context_->interactive());
  EXPECT_STREQ(context_->describe(), "X11 window");
  SceneView view(*context_, patient_, {640, 480, FixedViews::three, true});
  SceneState state;
  state.hud.phase = "Phase 1: puncture the skin";
  view.show(state);
  const Image frame = view.capture();
  EXPECT_EQ(frame.width, 640);
  EXPECT_EQ(frame.height, 480);
  std::set<int> shades;
  for (std::size_t i = 0; i + 2 < frame.pixels.size(); i += 3)
    shades.insert(frame.pixels[i] * 65536 + frame.pixels[i + 1] * 256 + frame.pixels[i + 2]);
  EXPECT_GT(shades.size(), 500u);
}

/// Two monitors side by side, as a server has them that knows of RandR 1.5.
class TwoMonitors {
 public:
  TwoMonitors() {
    EXPECT_EQ(std::system("xrandr --setmonitor left 640/160x800/200+0+0 screen > /dev/null && "
                          "xrandr --setmonitor right 640/160x800/200+640+0 none > /dev/null"),
              0);
  }
  ~TwoMonitors() {
    EXPECT_EQ(std::system("xrandr --delmonitor left; xrandr --delmonitor right"), 0);
  }
};

TEST_F(Window, StandsOnTheMonitorOfOnesChoiceFillsItAndComesBack) {
  if (std::system("xrandr > /dev/null 2>&1") != 0) GTEST_SKIP() << "no xrandr";
  const TwoMonitors two;
  const std::vector<Monitor> all = monitors();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[1].name, "right");
  EXPECT_EQ(all[1].x, 640);
  const auto context = makeGlContext(Display::window, {400, 300, false, "right"}, "Second");
  SceneView view(*context, patient_, {});
  view.show({});
  EXPECT_EQ(view.capture().width, 400) << "as large as the window was made";
  ASSERT_TRUE(context->place());
  EXPECT_EQ(context->place()->monitor, "right");
  EXPECT_FALSE(context->place()->full_screen);
  ASSERT_TRUE(person("mousemove 960 400"));  // over the window's middle
  ASSERT_TRUE(person("key F11"));
  pollUntil(view, [&](const ViewInput&) {
    view.show({});
    return context->place()->full_screen;
  });
  view.show({});
  EXPECT_EQ(view.capture().width, 640);
  EXPECT_EQ(view.capture().height, 800);
  EXPECT_EQ(context->place()->width, 400) << "where it goes back to";
  ASSERT_TRUE(person("key F11"));
  pollUntil(view, [&](const ViewInput&) {
    view.show({});
    return !context->place()->full_screen;
  });
  view.show({});
  EXPECT_EQ(view.capture().width, 400);
  EXPECT_EQ(view.capture().height, 300);
  EXPECT_EQ(context->place()->monitor, "right");
}

TEST_F(Window, BelongsToThePrograms) {
  EXPECT_EQ(std::system("test \"$(xdotool search --class "
                        "'^palpa$' | head -1)\""),
            0);
}

/// On a connection of its own: nobody polls the window meanwhile.
TEST_F(Window, TheStopKeyIsHeardPastWhoeverDraws) {
  SceneView view(*context_, patient_, {640, 480, FixedViews::three, true});
  view.show({});
  const std::unique_ptr<StopKey> key = context_->stopKey();
  ASSERT_TRUE(key);
  ASSERT_GE(key->descriptor(), 0);
  ASSERT_TRUE(mouse(123, 45));
  ASSERT_TRUE(person("key a"));
  ASSERT_TRUE(person("key space"));
  bool pressed = false;
  for (int i = 0; i < 300 && !pressed; ++i) {
    pressed = key->pressed();
    EXPECT_EQ(std::system("sleep 0.01"), 0);
  }
  EXPECT_TRUE(pressed);
  EXPECT_FALSE(key->pressed()) << "one press is one";
  ASSERT_TRUE(person("key b"));
  EXPECT_EQ(std::system("sleep 0.2"), 0);
  EXPECT_FALSE(key->pressed()) << "another key";
}

TEST_F(Window, HearsMouseKeysAndWheelAndNoKeyEndsTheProgram) {
  SceneView view(*context_, patient_, {640, 480, FixedViews::three, true});
  view.show({});
  ASSERT_TRUE(mouse(123, 45));
  const ViewInput moved = pollUntil(view, [](const ViewInput& i) { return i.mouse_x == 123; });
  EXPECT_EQ(moved.mouse_x, 123);
  EXPECT_EQ(moved.mouse_y, 45);

  ASSERT_TRUE(person("key e q p space Escape Left"));
  const std::vector<std::string> typed{"e", "q", "p", "space", "Escape", "Left"};
  const ViewInput keyed =
      pollUntil(view, [&](const ViewInput& i) { return i.keys.size() >= typed.size(); });
  EXPECT_EQ(keyed.keys, typed);
  EXPECT_FALSE(keyed.closed);

  ASSERT_TRUE(person("click 5 click 4 click 4 click 4"));
  EXPECT_EQ(pollUntil(view, [](const ViewInput& i) { return i.wheel >= 2; }).wheel, 2);

  ASSERT_TRUE(person("mousedown 1"));
  const bool down = pollUntil(view, [](const ViewInput& i) { return i.left_button; }).left_button;
  EXPECT_TRUE(down);
  ASSERT_TRUE(person("mouseup 1"));
  EXPECT_FALSE(pollUntil(view, [](const ViewInput& i) { return !i.left_button; }).left_button);
}

TEST_F(Window, MiddleDragWalksTheVirtualCameraUnlessAProtocolForbidsIt) {
  for (const bool free : {true, false}) {
    SceneView view(*context_, patient_, {640, 480, FixedViews::three, free});
    view.show({});
    const Pose before = view.arGeometry().X_CA;
    const auto at = [&](int x, int y) {
      EXPECT_TRUE(mouse(x, y));
      pollUntil(view, [x](const ViewInput& i) { return i.mouse_x == x; });
    };
    at(150, 200);
    ASSERT_TRUE(person("mousedown 2"));
    EXPECT_TRUE(pollUntil(view, [](const ViewInput& i) { return i.middle_button; }).middle_button);
    at(210, 230);
    ASSERT_TRUE(person("mouseup 2"));
    pollUntil(view, [](const ViewInput& i) { return !i.middle_button; });
    view.show({});
    EXPECT_EQ(view.arGeometry().X_CA.isApprox(before, 1e-9), !free);
    view.resetNavigation();
    view.show({});
    EXPECT_TRUE(view.arGeometry().X_CA.isApprox(before, 1e-12));
  }
}

TEST_F(Window, OffscreenInTheSameProcessStaysWithX11) {
  const auto other = makeGlContext(Display::offscreen, 320, 240, "");
  EXPECT_FALSE(other->interactive());
  EXPECT_STREQ(other->describe(), "offscreen X11");
  SceneView view(*other, patient_, {320, 240, FixedViews::three, true});
  view.show({});
  EXPECT_EQ(view.capture().width, 320);
}

/// The window, as another program finds it; 0: there is none.
::Window found(::Display* display) {
  ::Window root = DefaultRootWindow(display), parent = 0, *children = nullptr, of_title = 0;
  unsigned count = 0;
  XQueryTree(display, root, &root, &parent, &children, &count);
  for (unsigned i = 0; i < count; ++i) {
    char* title = nullptr;
    if (!XFetchName(display, children[i], &title)) continue;
    if (std::string(title) == kTitle) of_title = children[i];
    XFree(title);
  }
  XFree(children);
  return of_title;
}

/// What a window manager sends for the close button.
void askToClose() {
  ::Display* display = XOpenDisplay(nullptr);
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = found(display);
  event.xclient.message_type = XInternAtom(display, "WM_PROTOCOLS", False);
  event.xclient.format = 32;
  event.xclient.data.l[0] = static_cast<long>(XInternAtom(display, "WM_DELETE_WINDOW", False));
  XSendEvent(display, event.xclient.window, False, NoEventMask, &event);
  XCloseDisplay(display);
}

void destroyWindow() {
  ::Display* display = XOpenDisplay(nullptr);
  XDestroyWindow(display, found(display));
  XCloseDisplay(display);
}

TEST_F(Window, CloseButtonIsReportedAndTheSceneCanStillFinish) {
  SceneView view(*context_, patient_, {640, 480, FixedViews::three, true});
  view.show({});
  EXPECT_FALSE(view.poll().closed);
  askToClose();
  EXPECT_TRUE(pollUntil(view, [](const ViewInput& i) { return i.closed; }).closed);
  view.show({});  // the program decides when to end
  EXPECT_EQ(view.capture().width, 640);
}

/// Last: no other test has a window afterwards.
TEST_F(Window, OneThatIsGoneKeepsItsSizeAndTheSceneGoesOn) {
  for (const char* asked : {"XGetGeometry", "XGetWindowAttributes"}) {
    Dl_info from{};
    ASSERT_NE(dladdr(dlsym(RTLD_DEFAULT, asked), &from), 0);
    EXPECT_EQ(std::string(from.dli_fname).find("libX11"), std::string::npos)
        << "VTK and Mesa ask Xlib for the size, and take what lies on their stack";
  }
  bool lost = false;
  whenWindowIsLost([&] { lost = true; });
  SceneView view(*context_, patient_, {640, 480, FixedViews::three, true});
  view.show({});
  destroyWindow();
  for (int i = 0; i < 20; ++i) {
    view.show({});
    EXPECT_EQ(view.capture().width, 640);
    EXPECT_EQ(view.capture().height, 480);
  }
  EXPECT_TRUE(lost);
}

}  // namespace
}  // namespace palpa::scene
