#include <gtest/gtest.h>

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <optional>

#include "anatomy/base/error.h"
#include "tests/headset/worn.h"

/// A runtime that hangs in any of its calls, or whose process is stopped: the thread that uses the
/// headset goes on, is told so once, and has the headset again when the runtime answers.
namespace palpa::headset {
namespace {

constexpr const char* kWords =
    "the headset's runtime does not answer; the session goes on without it";
constexpr int kTries =
    30'000;  // a millisecond each at least: what does not hang does not need them

HeadsetViewSetup impatient() {
  HeadsetViewSetup setup = unhurried();
  setup.patience.frame = std::chrono::milliseconds(100);
  setup.patience.silent = std::chrono::milliseconds(150);
  return setup;
}

/// Holds up a function of the runtime until it is released.
class Hang {
 public:
  explicit Hang(const std::filesystem::path& folder) : file_(folder / "hang.txt") {
    release();
    std::filesystem::remove(file_.string() + ".reached");
  }
  std::string plan() const { return ";hang=" + file_.string(); }
  void at(const std::string& function) const { std::ofstream(file_) << function << '\n'; }
  void release() const { std::filesystem::remove(file_); }
  bool reached() const { return std::filesystem::exists(file_.string() + ".reached"); }
  bool isReached() const {  ///< sooner or later
    for (int i = 0; i < kTries && !reached(); ++i) usleep(1000);
    return reached();
  }

 private:
  std::filesystem::path file_;
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
  const test::ScratchFolder folder("hang");
  const Hang hang(folder.path());
  Worn worn("eyes=64x64,64x64;rate=500" + hang.plan() + (of_change ? ";fault=taken_off@12" : ""),
            0.03, impatient());
  ASSERT_TRUE(showsMore(*worn.view));
  hang.at(function);
  ASSERT_TRUE(
      goOnUntil(*worn.view, [&] { return hang.reached() && !worn.view->trouble().empty(); }));
  expectSilence(*worn.view);
  hang.release();
  EXPECT_TRUE(showsMore(*worn.view));
  const test::XrReport report = worn.over();
  expectClean(report, function);
  EXPECT_EQ(calls(report, "xrAcquireSwapchainImage"), calls(report, "xrReleaseSwapchainImage"));
  EXPECT_EQ(calls(report, "xrBeginFrame"), calls(report, "xrEndFrame"));
}

std::string nameOfCall(const testing::TestParamInfo<const char*>& info) { return info.param; }

INSTANTIATE_TEST_SUITE_P(Each, HungCall,
                         testing::Values("xrPollEvent", "xrBeginSession", "xrEndSession",
                                         "xrWaitFrame", "xrBeginFrame", "xrLocateViews",
                                         "xrSyncActions", "xrGetActionStateFloat",
                                         "xrGetActionStateBoolean", "xrGetActionStatePose",
                                         "xrLocateSpace", "xrAcquireSwapchainImage",
                                         "xrWaitSwapchainImage", "xrReleaseSwapchainImage",
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

/// One whose frames take longer than anybody waits for them loses none of them.
TEST(HungRuntime, OneThatIsSlowShowsEveryFrame) {
  for (const char* fault : {"none@1", "taken_off@3"}) {
    HeadsetViewSetup setup = unhurried();
    setup.patience.frame = std::chrono::milliseconds(10);
    Worn worn(std::string("eyes=64x64,64x64;rate=6;fault=") + fault, 0.03, setup);
    EXPECT_TRUE(goOnUntil(*worn.view, [&] { return worn.view->frames() >= 6; })) << fault;
    EXPECT_EQ(worn.view->silences(), 0) << fault;
    const auto shown = static_cast<int>(worn.view->frames());
    const test::XrReport report = worn.over();
    expectClean(report, fault);
    EXPECT_EQ(calls(report, "layers"), shown) << fault;
    EXPECT_LE(calls(report, "xrWaitFrame"), shown + 3) << fault << ": some frames at its end";
  }
}

constexpr const char* kFolderOfParent = "PALPA_TEST_HUNG";

/// In processes of their own: the loader gives no second instance where one is left behind.
class HungDeathTest : public testing::Test {
 protected:
  void SetUp() override {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    if (std::getenv(kFolderOfParent)) return;
    folder_.emplace("hung");
    setenv(kFolderOfParent, folder_->path().c_str(), 1);
  }
  void TearDown() override { unsetenv(kFolderOfParent); }

 private:
  std::optional<test::ScratchFolder> folder_;
};

/// Ends the program, whose runtime waits for ever for itself then if it is asked. What does not
/// end is killed.
template <class Good>
[[noreturn]] void endAfter(Good good) {
  alarm(60);
  const Hang hang(std::getenv(kFolderOfParent));
  const bool well = good(hang);
  setenv("PALPA_TEST_XR", hang.plan().c_str(), 1);
  std::exit(well ? 0 : 1);
}

bool closesHung(const std::string& function, const Hang& hang) {
  HeadsetViewSetup setup = impatient();
  setup.patience.closing = std::chrono::milliseconds(100);
  Worn worn("eyes=64x64,64x64;rate=500" + hang.plan(), 0.03, setup);
  const bool shown = showsMore(*worn.view);
  hang.at(function + " exit");
  for (int i = 0; i < 5; ++i) oneFrame(*worn.view);
  worn.view.reset();
  return shown && hang.isReached();
}

bool opensHung(const std::string& function, const Hang& hang) {
  hang.at(function + " exit");
  HeadsetViewSetup setup = impatient();
  setup.patience.opening = std::chrono::milliseconds(300);
  try {
    const Worn worn("eyes=64x64,64x64" + hang.plan(), 0.03, setup);
  } catch (const Error& error) {
    return hang.isReached() &&
           std::string(error.what()).find("does not answer") != std::string::npos;
  }
  return false;
}

TEST_F(HungDeathTest, ASessionAndItsProgramEndWhateverHangs) {
  for (const std::string function :
       {"xrPollEvent", "xrWaitFrame", "xrReleaseSwapchainImage", "xrRequestExitSession",
        "xrEndSession", "xrDestroySpace", "xrDestroySwapchain", "xrDestroyActionSet",
        "xrDestroySession", "xrDestroyInstance"})
    EXPECT_EXIT(endAfter([&](const Hang& hang) { return closesHung(function, hang); }),
                testing::ExitedWithCode(0), "")
        << function;
}

TEST_F(HungDeathTest, ARuntimeThatHangsAtTheStartIsRefused) {
  for (const std::string function : {"xrCreateInstance", "xrGetSystem", "xrCreateSession",
                                     "xrCreateSwapchain", "xrAttachSessionActionSets"})
    EXPECT_EXIT(endAfter([&](const Hang& hang) { return opensHung(function, hang); }),
                testing::ExitedWithCode(0), "")
        << function;
}

/// With the patience of a session: ten frames a second go on meanwhile, and after two seconds the
/// headset is silent. What it holds cannot be given back.
bool isSilentByItself(const Hang&) {
  Worn worn("eyes=64x64,64x64;fault=hung@6", 0.03, HeadsetViewSetup{});
  return worn.show(100) == 6 && worn.view->trouble().find("does not answer") != std::string::npos &&
         !worn.view->wait(true);
}

TEST_F(HungDeathTest, OneThatHangsIsGivenUp) {
  EXPECT_EXIT(endAfter(isSilentByItself), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace palpa::headset
