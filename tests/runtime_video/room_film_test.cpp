#include "apps/runtime/room_film.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "anatomy/base/error.h"
#include "ar/codecs/codecs.h"
#include "tests/support/files.h"
#include "tests/support/scratch_folder.h"

namespace palpa::runtime {
namespace {

struct Stands final : Clock {
  std::atomic<std::int64_t> now_ns{0};
  std::int64_t now() const noexcept override { return now_ns.load(); }
  std::int64_t ofMonotonic(std::int64_t t_ns) const noexcept override {
    return t_ns - 1000 * kSecond;
  }
};

/// Gives `pictures` pictures, each as bright as its number, `apart` apart by its driver's stamps;
/// fails at the picture `fails`.
struct Played final : ar::Camera {
  Played(Stands& at_clock, std::int64_t apart_ns, int how_many, int fails_at = -1)
      : clock(at_clock), apart(apart_ns), pictures(how_many), fails(fails_at) {}
  std::optional<ar::Frame> grab() override {
    if (next == fails) {
      ++next;
      throw Error("has gone", "/dev/video2", "Look at its cable");
    }
    if (next >= pictures) return std::nullopt;
    clock.now_ns += apart;
    ar::Frame frame;
    frame.t_exposure_ns = 1000 * kSecond + clock.now_ns - 3 * kMillisecond;
    frame.image = cv::Mat(720, 1280, CV_8UC3, cv::Scalar::all(20 + next));
    ++next;
    return frame;
  }
  Stands& clock;
  std::int64_t apart;
  int pictures, fails, next = 0;
};

/// Steps until it is finished: at the times it asks for, or whenever the camera has given some.
void play(RoomFilm& film, Stands& clock, bool waits) {
  EXPECT_TRUE(comesTrue(std::chrono::seconds(60), [&] {
    const std::int64_t next = film.step(clock.now());
    if (!waits && next != kNever) clock.now_ns = next;
    return next == kNever;
  }));
}

struct Line {
  std::int64_t t_ns = 0;
  std::size_t offset = 0;
};

std::vector<Line> linesOf(const std::filesystem::path& table) {
  std::ifstream in(table);
  std::string text;
  std::getline(in, text);
  EXPECT_EQ(text, "number,t_exposure_ns,offset");
  std::vector<Line> lines;
  while (std::getline(in, text)) {
    Line line;
    const std::size_t first = text.find(','), second = text.find(',', first + 1);
    line.t_ns = std::stoll(text.substr(first + 1));
    line.offset = std::stoul(text.substr(second + 1));
    lines.push_back(line);
  }
  return lines;
}

TEST(RoomFilm, KeepsEightPicturesASecondWithTheirTimesAndPlaces) {
  const test::ScratchFolder folder("room");
  Stands clock;
  {
    RoomFilm film([&] { return std::make_unique<Played>(clock, 20 * kMillisecond, 100); }, true,
                  folder.path(), clock);
    play(film, clock, true);
    EXPECT_EQ(film.trouble(), "");
    EXPECT_EQ(film.news(), "");
    EXPECT_EQ(film.pictures(), 15u);  // of two seconds at 140 ms, a multiple of the camera's 20
  }
  const std::string film = test::slurp(folder / "room.mjpeg");
  const std::vector<Line> lines = linesOf(folder / "room.mjpeg.csv");
  ASSERT_EQ(lines.size(), 15u);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_EQ(film.substr(lines[i].offset, 2), "\xff\xd8") << "a JPEG begins there";
    if (i > 0) {
      EXPECT_GE(lines[i].t_ns - lines[i - 1].t_ns, 125 * kMillisecond);
    }
  }
  EXPECT_EQ(lines[0].t_ns, 17 * kMillisecond) << "when it was exposed, not when it came";
  const std::vector<char> first(film.begin(),
                                film.begin() + static_cast<std::ptrdiff_t>(lines[1].offset));
  const cv::Mat picture = ar::decode(first, cv::IMREAD_COLOR);
  EXPECT_EQ(picture.cols, 640);
  EXPECT_EQ(picture.rows, 360);
}

TEST(RoomFilm, ACameraThatFailsIsAskedAgain) {
  const test::ScratchFolder folder("room-fails");
  Stands clock;
  int opened = 0;
  RoomFilm film(
      [&]() -> std::unique_ptr<ar::Camera> {
        if (++opened == 2) throw Error("is not there", "/dev/video2", "Plug it in");
        return std::make_unique<Played>(clock, 200 * kMillisecond, 10, opened == 1 ? 5 : -1);
      },
      true, folder.path(), clock);
  play(film, clock, true);
  EXPECT_EQ(opened, 3);
  EXPECT_EQ(film.pictures(), 15u);
  EXPECT_NE(film.trouble().find("/dev/video2"), std::string::npos);
  EXPECT_EQ(film.news(), "The room is not filmed: " + film.trouble());
  EXPECT_EQ(film.news(), "") << "once";
}

// A driver may wait for ever for a picture that does not come.
TEST(RoomFilm, ACameraThatHangsHoldsNothingUp) {
  struct Hangs final : ar::Camera {
    explicit Hangs(std::shared_future<void> until) : end(std::move(until)) {}
    std::optional<ar::Frame> grab() override {
      end.wait();
      return std::nullopt;
    }
    std::shared_future<void> end;
  };
  const test::ScratchFolder folder("room-hangs");
  Stands clock;
  std::promise<void> end;
  const std::shared_future<void> ended = end.get_future().share();
  {
    RoomFilm film([&] { return std::make_unique<Hangs>(ended); }, true, folder.path(), clock);
    EXPECT_LT(film.step(0), kSecond);
    EXPECT_EQ(film.pictures(), 0u);
  }  // comes back although the camera does not
  end.set_value();
}

TEST(RoomFilm, AFilmThatIsThereIsNotWrittenOver) {
  const test::ScratchFolder folder("room-twice");
  Stands clock;
  const auto never = []() -> std::unique_ptr<ar::Camera> { return nullptr; };
  const RoomFilm film(never, false, folder.path(), clock);
  EXPECT_THROW(RoomFilm(never, false, folder.path(), clock), Error);
}

// As on a full disk: the limit of a file's size is one that a test can set.
TEST(RoomFilm, WhatCannotBeWrittenEndsTheFilm) {
  const test::ScratchFolder folder("room-full");
  Stands clock;
  RoomFilm film([&] { return std::make_unique<Played>(clock, kSecond, 1000); }, false,
                folder.path(), clock);
  ::rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  auto* const ignored = std::signal(SIGXFSZ, SIG_IGN);
  const ::rlimit small{30'000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  play(film, clock, false);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, ignored);
  EXPECT_NE(film.trouble().find("disk"), std::string::npos);
  EXPECT_GT(film.pictures(), 0u);
  EXPECT_LT(film.pictures(), 100u);
}

}  // namespace
}  // namespace palpa::runtime
