#include <gtest/gtest.h>

#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "anatomy/base/error.h"
#include "tests/headset/worn.h"

/// A runtime that hangs in any of its calls, or whose process is stopped: the thread that uses the
/// headset goes on, is told so once, and has the headset again when the runtime answers.
namespace palpa::headset {
namespace {

constexpr const char* kWords =
    "the headset's runtime does not answer; the session goes on without it";
constexpr int kTries = 30'000;  // a millisecond each at least: what does not hang does not need them

HeadsetViewSetup impatient() {
  HeadsetViewSetup setup;
  setup.patience.silent = std::chrono::milliseconds(150);
  setup.patience.opening = std::chrono::seconds(60);
  setup.patience.closing = std::chrono::seconds(60);
  return setup;
}

/// Holds up a function of the runtime until it is released.
class Hang {
 public:
  std::string plan() const { return ";hang=" + file().string(); }
  void at(const std::string& function) const { std::ofstream(file()) << function << '\n'; }
  void release() const { std::filesystem::remove(file()); }
  bool reached() const { return std::filesystem::exists(file().string() + ".reached"); }

 private:
  std::filesystem::path file() const { return folder_ / "hang.txt"; }
  test::ScratchFolder folder_{"hang"};
};

/// One frame, and a pulse in the hand; whether it was shown.
bool oneFrame(HeadsetView& view) {
  const bool shown = view.wait(true);
  if (shown) view.show(Worn::bare());
  view.pulse(0.01, 0.5);
  return shown;
}

/// Goes on until it is so, or no hope is left.
template <class So>
bool goOnUntil(HeadsetView& view, So so) {
  for (int i = 0; i < kTries && !so(); ++i) {
    oneFrame(view);
    usleep(1000);
  }
  return so();
}

bool showsMore(HeadsetView& view) {
  const std::uint64_t before = view.frames();
  return goOnUntil(view, [&] { return view.frames() >= before + 3 && view.trouble().empty(); });
}

/// While it hangs: nothing is shown, and it is said once.
void expectSilence(HeadsetView& view) {
  EXPECT_EQ(view.trouble(), kWords);
  const std::uint64_t frames = view.frames();
  const int silences = view.silences();
  EXPECT_GE(silences, 1);
  for (int i = 0; i < 30; ++i) EXPECT_FALSE(oneFrame(view));
  EXPECT_EQ(view.silences(), silences);
  EXPECT_EQ(view.frames(), frames);
  EXPECT_EQ(view.trouble(), kWords);
}

class HungCall : public testing::TestWithParam<const char*> {};

TEST_P(HungCall, HoldsNobodyUpAndComesBack) {
  const std::string function = GetParam();
  const bool of_change = function == "xrEndSession" || function == "xrBeginSession";
  const Hang hang;
  Worn worn("eyes=64x64,64x64;rate=500" + hang.plan() + (of_change ? ";fault=taken_off@12" : ""),
            0.03, impatient());
  ASSERT_TRUE(showsMore(*worn.view));
  hang.at(function);
  ASSERT_TRUE(goOnUntil(*worn.view,
                        [&] { return hang.reached() && !worn.view->trouble().empty(); }));
  expectSilence(*worn.view);
  hang.release();
  EXPECT_TRUE(showsMore(*worn.view));
  const test::XrReport report = worn.over();
  expectClean(report, function);
  EXPECT_EQ(calls(report, "xrAcquireSwapchainImage"), calls(report, "xrReleaseSwapchainImage"));
  EXPECT_EQ(calls(report, "xrBeginFrame"), calls(report, "xrEndFrame"));
}

std::string nameOfCall(const testing::TestParamInfo<const char*>& info) { return info.param; }

INSTANTIATE_TEST_SUITE_P(
    Each, HungCall,
    testing::Values("xrPollEvent", "xrBeginSession", "xrEndSession", "xrWaitFrame", "xrBeginFrame",
                    "xrLocateViews", "xrSyncActions", "xrGetActionStateFloat",
                    "xrGetActionStateBoolean", "xrGetActionStatePose", "xrLocateSpace",
                    "xrAcquireSwapchainImage", "xrWaitSwapchainImage", "xrReleaseSwapchainImage",
                    "xrEndFrame", "xrApplyHapticFeedback"),
    nameOfCall);

int processIn(const std::filesystem::path& file) {
  int process = 0;
  std::ifstream(file) >> process;
  return process;
}

TEST(HungRuntime, WhoseProcessIsStoppedHoldsNobodyUpAndComesBack) {
  const test::ScratchFolder folder("service");
  Worn worn("eyes=64x64,64x64;rate=500;service=" + (folder / "process.txt").string(), 0.03,
            impatient());
  ASSERT_TRUE(showsMore(*worn.view));
  const int process = processIn(folder / "process.txt");
  ASSERT_GT(process, 1);
  for (int again = 0; again < 2; ++again) {
    ASSERT_EQ(kill(process, SIGSTOP), 0);
    EXPECT_TRUE(goOnUntil(*worn.view, [&] { return !worn.view->trouble().empty(); }));
    expectSilence(*worn.view);
    ASSERT_EQ(kill(process, SIGCONT), 0);
    EXPECT_TRUE(showsMore(*worn.view));
  }
  expectClean(worn.over(), "stopped");
}

/// What does not end is ended, as a failure.
void endsInTime() { alarm(60); }

[[noreturn]] void end(bool good) { std::exit(good ? 0 : 1); }

/// Ends a program whose runtime hangs; and when it ends, that runtime waits for itself for ever.
[[noreturn]] void closeHung(const std::string& function) {
  endsInTime();
  const Hang hang;
  HeadsetViewSetup setup = impatient();
  setup.patience.closing = std::chrono::milliseconds(100);
  Worn worn("eyes=64x64,64x64;rate=500" + hang.plan(), 0.03, setup);
  bool good = showsMore(*worn.view);
  hang.at(function + " exit");
  for (int i = 0; i < 5; ++i) oneFrame(*worn.view);
  worn.view.reset();
  good &= hang.reached();
  end(good);
}

[[noreturn]] void openHung(const std::string& function) {
  endsInTime();
  const Hang hang;
  hang.at(function + " exit");
  HeadsetViewSetup setup = impatient();
  setup.patience.opening = std::chrono::milliseconds(1500);
  try {
    const Worn worn("eyes=64x64,64x64" + hang.plan(), 0.03, setup);
  } catch (const Error& error) {
    end(hang.reached() && std::string(error.what()).find("does not answer") != std::string::npos);
  }
  end(false);
}

/// Each in a process of its own: the loader gives no second instance where one is left behind.
class HungDeathTest : public testing::Test {
 protected:
  void SetUp() override { testing::FLAGS_gtest_death_test_style = "threadsafe"; }
};

TEST_F(HungDeathTest, ASessionAndItsProgramEndWhateverHangs) {
  for (const char* function :
       {"xrPollEvent", "xrWaitFrame", "xrReleaseSwapchainImage", "xrRequestExitSession",
        "xrEndSession", "xrDestroySpace", "xrDestroySwapchain", "xrDestroyActionSet",
        "xrDestroySession", "xrDestroyInstance"})
    EXPECT_EXIT(closeHung(function), testing::ExitedWithCode(0), "") << function;
}

TEST_F(HungDeathTest, ARuntimeThatHangsAtTheStartIsRefused) {
  for (const char* function :
       {"xrCreateInstance", "xrGetSystem", "xrCreateSession", "xrCreateSwapchain",
        "xrAttachSessionActionSets"})
    EXPECT_EXIT(openHung(function), testing::ExitedWithCode(0), "") << function;
}

/// With the patience of a session: ten frames a second go on meanwhile, and after two seconds the
/// headset is silent.
[[noreturn]] void hangWithTheUsualPatience() {
  endsInTime();
  Worn worn("eyes=64x64,64x64;fault=hung@6");
  bool good = worn.show(100) == 6;
  good &= worn.view->trouble().find("does not answer") != std::string::npos;
  good &= !worn.view->wait(true);
  worn.view.reset();  // what it holds cannot be given back
  end(good);
}

TEST_F(HungDeathTest, OneThatHangsIsGivenUp) {
  EXPECT_EXIT(hangWithTheUsualPatience(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace palpa::headset
