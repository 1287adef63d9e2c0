#include "apps/sound/loudspeaker.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>

#include "anatomy/base/whole_file.h"
#include "apps/sound/tones.h"
#include "fake_output.h"
#include "tests/support/files.h"
#include "tests/support/hang_watch.h"

namespace palpa::sound {
namespace {

constexpr int kDone = 0, kGap = 3, kWrong = 4;
constexpr std::int64_t kBeats_ns[] = {0, 500'000'000, 1'250'000'000};
constexpr std::int64_t kAlarm_ns = 2'000'000'000;

/// OpenAL Soft reads its settings once a process: each of them is tried in one of its own.
void drivenBy(const char* drivers, const std::filesystem::path& settings = "/dev/null") {
  setenv("ALSOFT_DRIVERS", drivers, 1);
  setenv("ALSOFT_CONF", settings.c_str(), 1);
  setenv("ALSOFT_LOGLEVEL", "0", 1);
}

bool hasOpened(const Loudspeaker& speaker) {
  return runtime::comesTrue(std::chrono::seconds(30),
                            [&speaker] { return speaker.state() != Loudspeaker::State::opening; });
}

/// In a process of its own: three beats and an alarm, at these times after the first.
[[noreturn]] void playIntoFile() {
  const test::HangWatch watch(std::chrono::seconds(60));
  const runtime::SteadyClock clock;
  int gaps = 0;
  {
    Loudspeaker speaker(clock);
    if (!hasOpened(speaker) || speaker.state() != Loudspeaker::State::playing) std::_Exit(kWrong);
    const std::int64_t first_ns = clock.now() + 200 * runtime::kMillisecond;
    for (const std::int64_t t_ns : kBeats_ns) speaker.play({Cue::beat, first_ns + t_ns});
    speaker.play({Cue::alarm, first_ns + kAlarm_ns});
    clock.sleepUntil(first_ns + kAlarm_ns + runtime::kSecond);
    gaps = speaker.gaps();
  }
  std::_Exit(gaps > 0 ? kGap : kDone);
}

template <class T>
T at(const std::string& bytes, std::size_t place) {
  T value{};
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}

/// The first channel of a RIFF file, whose rate must be ours.
std::vector<double> samplesOf(const std::string& bytes) {
  std::vector<double> samples;
  const std::size_t format = bytes.find("fmt "), data = bytes.find("data");
  if (format == std::string::npos || data == std::string::npos) return samples;
  const auto channels = at<std::uint16_t>(bytes, format + 10);
  const auto bits = at<std::uint16_t>(bytes, format + 22);
  EXPECT_EQ(at<std::uint32_t>(bytes, format + 12), static_cast<std::uint32_t>(kRate_Hz));
  const std::size_t frame = channels * bits / 8u;
  for (std::size_t place = data + 8; frame > 0 && place + frame <= bytes.size(); place += frame)
    samples.push_back(bits == 16 ? at<std::int16_t>(bytes, place) / 32767.
                                 : static_cast<double>(at<float>(bytes, place)));
  return samples;
}

/// Index of the first sample from `from` on, before `to`, that has a tenth of the largest there.
template <class Samples>
std::ptrdiff_t onsetIn(const Samples& samples, std::ptrdiff_t from, std::ptrdiff_t to) {
  const auto begin = samples.begin() + from;
  const auto end = samples.begin() + std::min<std::ptrdiff_t>(to, std::ssize(samples));
  double largest = 0;
  for (auto one = begin; one < end; ++one)
    largest = std::max(largest, std::abs(static_cast<double>(*one)));
  return std::find_if(begin, end,
                      [largest](auto sample) {
                        return std::abs(static_cast<double>(sample)) >= 0.1 * largest;
                      }) -
         samples.begin();
}

std::ptrdiff_t onsetOf(Cue cue) {
  const std::vector<float> tone = toneOf(voiceOf(cue));
  return onsetIn(tone, 0, std::ssize(tone));
}

std::ptrdiff_t samplesIn(std::int64_t t_ns) { return t_ns / 1000 * kRate_Hz / 1'000'000; }

class Played : public testing::Test {
 protected:
  void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
  /// OpenAL Soft's, where it plays into this file.
  std::filesystem::path settingsFor(const std::filesystem::path& file) const {
    std::ofstream(folder_ / "alsoft.conf")
        << "[general]\nstereo-mode = speakers\nhrtf = false\n[wave]\nfile = " << file.string()
        << "\n";
    return folder_ / "alsoft.conf";
  }
  std::filesystem::path folder_ = test::freshFolder("sound", "wave");
};

/// By the file's own clock, its samples: each cue is as long after the first as it was asked to be,
/// to 1 ms. A computer that is too slow leaves a gap, which the loudspeaker counts.
void expectInTime(const std::vector<double>& samples) {
  const auto heard = std::find_if(samples.begin(), samples.end(),
                                  [](double sample) { return std::abs(sample) > 1e-3; });
  ASSERT_NE(heard, samples.end()) << "nothing is in it";
  const std::ptrdiff_t near = heard - samples.begin();
  constexpr std::ptrdiff_t kBefore = kRate_Hz / 20, kAfter = kRate_Hz / 4;  // 50, 250 ms
  ASSERT_GT(near, kBefore);
  const std::ptrdiff_t first = onsetIn(samples, near - kBefore, near + kAfter) - onsetOf(Cue::beat);
  const auto expectAt = [&](Cue cue, std::int64_t t_ns) {
    const std::ptrdiff_t expected = first + samplesIn(t_ns);
    ASSERT_LT(expected + kAfter, std::ssize(samples));
    EXPECT_NEAR(
        static_cast<double>(onsetIn(samples, expected - kBefore, expected + kAfter) - onsetOf(cue)),
        static_cast<double>(expected), kRate_Hz / 1000.)
        << t_ns;
  };
  for (const std::int64_t t_ns : kBeats_ns) expectAt(Cue::beat, t_ns);
  expectAt(Cue::alarm, kAlarm_ns);
}

using Wave = Played;

TEST_F(Wave, EveryCueIsWhereItBelongsToAMillisecond) {
  const std::filesystem::path file = folder_ / "sound.wav";
  const std::filesystem::path settings = settingsFor(file);
  bool had_gap = false;
  EXPECT_EXIT(
      {
        drivenBy("wave", settings);
        playIntoFile();
      },
      [&had_gap](int status) {
        had_gap = testing::ExitedWithCode(kGap)(status);
        return had_gap || testing::ExitedWithCode(kDone)(status);
      },
      "");
  const std::vector<double> samples = samplesOf(readWhole(file).value_or(""));
  ASSERT_GT(samples.size(), static_cast<std::size_t>(2 * kRate_Hz));
  if (had_gap) GTEST_SKIP() << "this computer was too busy to play without a gap";
  expectInTime(samples);
}

using Device = Played;

[[noreturn]] void exitWith(bool right) { std::_Exit(right ? kDone : kWrong); }

TEST_F(Device, ThatIsNoneIsSaidAndCuesGoNowhere) {
  EXPECT_EXIT(
      {
        drivenBy("there_is_no_such_driver");
        const runtime::SteadyClock clock;
        Loudspeaker speaker(clock);
        const bool opened = hasOpened(speaker);
        for (int i = 0; i < 1000; ++i) speaker.play({Cue::alarm, clock.now()});
        exitWith(opened && speaker.state() == Loudspeaker::State::silent &&
                 speaker.words().find("No sound device") == 0);
      },
      testing::ExitedWithCode(kDone), "");
}

TEST_F(Device, ThatPlaysToNobodyIsOne) {
  EXPECT_EXIT(
      {
        drivenBy("null");
        const SpeakerFound found = askSpeaker(30 * runtime::kSecond);
        exitWith(found.state == Loudspeaker::State::playing && !found.words.empty());
      },
      testing::ExitedWithCode(kDone), "");
}

/// A process ends as it should although a call into the library never comes back.
TEST_F(Device, ThatHangsWhileItIsOpenedHoldsUpNobodysEnd) {
  EXPECT_EXIT(
      {
        const test::HangWatch watch(std::chrono::seconds(30));
        const runtime::SteadyClock clock;
        std::promise<void> never;
        const auto hang = [silence = never.get_future().share()]() -> std::unique_ptr<Output> {
          silence.wait();
          return nullptr;
        };
        {
          Loudspeaker speaker(clock, hang);
          speaker.play({Cue::alarm, clock.now()});
        }
        const SpeakerFound found = askSpeaker(50 * runtime::kMillisecond, hang);
        std::exit(found.state == Loudspeaker::State::opening ? kDone : kWrong);
      },
      testing::ExitedWithCode(kDone), "");
}

/// The same in the library itself: a pipe that nobody reads is opened for ever, and what the
/// library does when a program ends is not waited for.
TEST_F(Device, ThatHangsInTheLibraryHoldsUpNobodysEnd) {
  const std::filesystem::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::filesystem::path settings = settingsFor(pipe);
  EXPECT_EXIT(
      {
        const test::HangWatch watch(std::chrono::seconds(30));
        drivenBy("wave", settings);
        const SpeakerFound found = askSpeaker(300 * runtime::kMillisecond);
        std::exit(found.state == Loudspeaker::State::opening ? kDone : kWrong);
      },
      testing::ExitedWithCode(kDone), "");
}

TEST(Loudspeaker, SaysThatADeviceIsGoneWhilePlaying) {
  class Vanishing final : public Output {
    std::string name() const override { return "one that vanishes"; }
    std::optional<int> room() override { throw std::runtime_error("No sound device: it is gone"); }
    void write(std::span<const std::int16_t>) override {}
  };
  const runtime::SteadyClock clock;
  const Loudspeaker speaker(clock, [] { return std::make_unique<Vanishing>(); });
  EXPECT_TRUE(runtime::comesTrue(std::chrono::seconds(10), [&speaker] {
    return speaker.state() == Loudspeaker::State::silent;
  }));
  EXPECT_EQ(speaker.words(), "No sound device: it is gone");
}

TEST(Loudspeaker, PlaysWhatItIsTold) {
  const auto taken = std::make_shared<Taken>();
  const runtime::SteadyClock clock;
  Loudspeaker speaker(clock, openFake(taken));
  EXPECT_EQ(largestIn(taken->next(10)), 0);
  speaker.play({Cue::blood, clock.now()});
  EXPECT_NEAR(largestIn(taken->next(40)), amplitudeOf(voiceOf(Cue::blood).level_dBFS), 0.01);
}

}  // namespace
}  // namespace palpa::sound
