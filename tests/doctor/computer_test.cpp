#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/fonts.h"
#include "apps/doctor/computer_check.h"
#include "says.h"
#include "tests/support/files.h"

namespace palpa::doctor {
namespace {

namespace fs = std::filesystem;

TEST(DoctorsComputer, ClocksThatDoNotAgreeAreNamed) {
  expectSays(judgeClocks({1, 1, 0.2, true}, {}, true), State::well, "kept by a time server");
  expectSays(judgeClocks({1, 1, 0.2, false}, {}, false), State::well, "the date goes with them");
  expectSays(judgeClocks({1, 1, 0.2, false}, {}, true), State::note, "no time server");
  expectSays(judgeClocks({1, 1, -3600'000, true}, {}, false), State::note,
             "was set by -3600000 ms");
  expectSays(judgeClocks({4'000'000, 1, 0, true}, {}, false), State::note, "steps by 4.0 ms");
  const ClockWatch watch;
  runtime::SteadyClock().sleepUntil(20 * runtime::kMillisecond);
  EXPECT_GT(watch.facts().seconds, 0.02);
  EXPECT_GT(watch.facts().resolution_ns, 0);
}

TEST(DoctorsComputer, LoopDiskAndDateAreJudged) {
  expectSays(judgeLoop({"SCHED_FIFO", 1000, 40}, true), State::well, "in real time");
  expectSays(judgeLoop({"normal priority: SCHED_FIFO refused (this user may not)", 1000, 40}, true),
             State::note, "normal priority");
  expectSays(judgeLoop({"SCHED_FIFO", 640, 900}, true), State::note, "will stutter");
  expectSays(judgeLoop({"SCHED_FIFO", 640, 900}, false), State::well, "virtual bench");
  expectSays(judgeLoop({"SCHED_FIFO", 1000, 40,
                        "memory not locked: refused (beyond this user's limit, ulimit -l)"},
                       true),
             State::note, "put out to disk");
  EXPECT_GT(measureLoop().rate_Hz, 100);
  expectSays(judgeDisk({"/data", true, 50'000'000'000}), State::well, "50.0 GB free");
  expectSays(judgeDisk({"/data", true, 1'000'000'000}), State::note, "enough for some 80 trials");
  expectSays(judgeDisk({"/data", true, 100'000'000}), State::ill, "0.1 GB free");
  expectSays(judgeDisk({"/data", false, 50'000'000'000}), State::ill, "may not be written");
  EXPECT_GT(measureDisk("not/there/yet").free_bytes, 0u);
  expectSays(judgeDate("1970-01-01T00:03:00Z", "2026-01-01T00:00:00Z"), State::ill, "1970-01-01");
  expectSays(judgeDate("2027-01-01T00:03:00Z", "2026-01-01T00:00:00Z"), State::well,
             "2027-01-01 00:03");
}

TEST(DoctorsComputer, LettersOfEveryLanguageCanBeDrawn) {
  expectSays(judgeLetters(), State::well, "Korean");
  const fs::path root = test::freshFolder("doctor", "letters");
  const Finding none = judgeLetters(root);
  expectSays(none, State::note, "Greek and Cyrillic");
  EXPECT_EQ(none.fix, "Install the package fonts-dejavu-core");
  for (const char* file : {fontOf("A").plain, fontOf("A").bold}) {
    const auto place = root / std::string(file).substr(1);
    fs::create_directories(place.parent_path());
    std::ofstream(place) << "a font";
  }
  EXPECT_EQ(judgeLetters(root).fix, "Install the package fonts-nanum");
}

TEST(DoctorsComputer, MonitorsAndWhyThereIsNoWindow) {
  expectSays(judgeDesktop({"", "", true, {"HDMI-1, 1920x1080 (primary)", "DP-2, 3840x2160"}}),
             State::well, "1: HDMI-1, 1920x1080 (primary); 2: DP-2, 3840x2160");
  const Finding wayland =
      judgeDesktop({"this desktop is Wayland's", "Install the package xwayland", true, {}});
  expectSays(wayland, State::note, "Wayland");
  EXPECT_NE(wayland.fix.find("xwayland"), std::string::npos);
  expectSays(judgeDesktop({"DISPLAY is not set", "Start a desktop", false, {}}), State::absent,
             "no desktop");
  expectSays(askDrawing([] {
               return Drawing{"EGL device", "A", false, {"A", "/dev/dri/card1"}};
             }),
             State::well, "(--gpu): 1 (A), 2 (/dev/dri/card1)");
}

TEST(DoctorsComputer, DrawingAndHeadset) {
  expectSays(askDrawing([] {
               return Drawing{"X11 window", "NVIDIA RTX 4000/PCIe", false};
             }),
             State::well, "drawn on NVIDIA RTX 4000/PCIe by OpenGL (X11 window)");
  expectSays(askDrawing([] {
               return Drawing{"surfaceless EGL", "llvmpipe (256 bits)", true};
             }),
             State::well, "without a graphics card, on the processor: llvmpipe (256 bits)");
  expectSays(askDrawing([]() -> Drawing {
               throw Error("cannot be made", "OpenGL context", "Install a driver");
             }),
             State::ill, "cannot be made");
  const fs::path folder = test::freshFolder("doctor", "headset");
  const auto runtime = [&](const std::string& text) {
    std::ofstream(folder / "runtime.json") << text;
    return judgeHeadset(folder / "runtime.json");
  };
  expectSays(judgeHeadset({}), State::absent, "no OpenXR runtime");
  expectSays(judgeHeadset(folder / "nowhere.json"), State::note, "cannot be read");
  expectSays(runtime("{"), State::note, "damaged");
  expectSays(runtime(R"({"runtime": {}})"), State::note, "names no library");
  expectSays(runtime(R"({"runtime": {"library_path": "./libxr.so"}})"), State::note,
             "not where its file says");
  std::ofstream(folder / "libxr.so") << "";
  expectSays(runtime(R"({"runtime": {"library_path": "./libxr.so"}})"), State::well, "libxr.so");
}

TEST(DoctorsComputer, SoundIsTheDevicesOrIsMissedByNobody) {
  using Speaker = sound::Loudspeaker::State;
  expectSays(judgeSound({Speaker::playing, "Built-in Audio"}), State::well, "on Built-in Audio");
  expectSays(judgeSound({Speaker::silent, "No sound device: the system has none"}), State::absent,
             "No sound device: the system has none. Sessions go on in silence");
  expectSays(judgeSound({Speaker::opening, ""}), State::note, "does not answer");
}

/// The variable as it was again at the end.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    ::setenv(name, value, 1);
  }
  ~Environment() {
    if (before_)
      ::setenv(name_, before_->c_str(), 1);
    else
      ::unsetenv(name_);
  }

 private:
  const char* name_;
  std::optional<std::string> before_;
};

TEST(DoctorsComputer, ALanguageThatIsNotInstalledIsNamed) {
  {
    const Environment language("LC_ALL", "xx_YY.UTF-8");
    expectSays(askLocale(), State::note, "xx_YY");
  }
  {
    const Environment language("LC_ALL", "C.UTF-8");
    expectSays(askLocale(), State::well, "C.UTF-8");
  }
  EXPECT_EQ(askAssets().state, State::well);
}

TEST(Doctor, SaysWhetherASessionCanStart) {
  const Findings fine{
      {"a", State::well, "x"}, {"b", State::note, "y", "z"}, {"c", State::absent, "none"}};
  EXPECT_TRUE(canStart(fine));
  Findings ill = fine;
  ill.push_back({"d", State::ill, "broken <&\"", "mend"});
  EXPECT_FALSE(canStart(ill));
  const nlohmann::json json = nlohmann::json::parse(toJson(ill));
  EXPECT_EQ(json["can_start"], false);
  ASSERT_EQ(json["findings"].size(), 4u);
  EXPECT_EQ(json["findings"][3],
            (nlohmann::json{
                {"subject", "d"}, {"state", "ill"}, {"verdict", "broken <&\""}, {"fix", "mend"}}));
  const Finding torn = troubled("x", State::ill, "file a: is damaged. Restore it. Then go on");
  EXPECT_EQ(torn.verdict, "file a: is damaged");
  EXPECT_EQ(torn.fix, "Restore it. Then go on");
}

}  // namespace
}  // namespace palpa::doctor
