#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "program.h"

/// A recorded trial seen again: two seconds of it, small.
namespace palpa::cli_test {
namespace {

const Folder& recordedNeedle() {
  static const Folder here;
  static const Outcome outcome = palpa(session({"--seed", "1", "--out", "A"}), here.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return here;
}

Outcome film(std::vector<std::string> more) {
  more.insert(more.begin(), {"replay", "A/session.palpa"});
  return palpa(more, recordedNeedle().path());
}

std::vector<cv::Mat> framesOf(const std::filesystem::path& file) {
  std::vector<cv::Mat> frames;
  cv::VideoCapture capture(file.string());
  for (cv::Mat frame; capture.read(frame);) frames.push_back(frame.clone());
  return frames;
}

/// Columns of the strip that show the part that was played: of the calm notice's blue.
int playedColumns(const cv::Mat& frame) {
  int columns = 0;
  for (int u = 0; u < frame.cols * 7 / 10; ++u) {
    bool blue = false;
    for (int v = frame.rows - 34; v < frame.rows - 6; ++v) {
      const cv::Vec3b& p = frame.at<cv::Vec3b>(v, u);
      blue = blue || (p[0] > 150 && p[0] > p[2] + 60 && p[1] > p[2] + 25);
    }
    columns += blue ? 1 : 0;
  }
  return columns;
}

TEST(ReplayView, AFilmHasItsPicturesTheirMotionAndTheStrip) {
  const Outcome outcome =
      film({"--video", "a.avi", "--from", "4", "--to", "6", "--size", "320x240"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "a.avi (50 pictures, 2.0 s)")) << outcome.out;
  const std::vector<cv::Mat> frames = framesOf(recordedNeedle() / "a.avi");
  ASSERT_EQ(frames.size(), 50u);
  EXPECT_EQ(frames[0].cols, 320);
  EXPECT_EQ(frames[0].rows, 240);
  cv::Mat difference;
  cv::absdiff(frames.front(), frames.back(), difference);
  EXPECT_GT(cv::norm(difference, cv::NORM_L1) / static_cast<double>(difference.total()), 0.1);
  EXPECT_GT(playedColumns(frames.front()), 5);
  EXPECT_GT(playedColumns(frames.back()), playedColumns(frames.front()) + 3);
}

TEST(ReplayView, HalfTheSpeedIsTwiceThePictures) {
  const Outcome outcome = film(
      {"--video", "b.mp4", "--from", "4", "--to", "4.4", "--speed", "0.5", "--size", "320x240"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(framesOf(recordedNeedle() / "b.mp4").size(), 20u);
}

struct SeenAgain {
  std::vector<std::string> task;
  const char *from = "1", *to = "3", *speed = "2";  ///< one second of film
};

/// Seen again: the picture moves, and the strip with it.
TEST(ReplayView, EveryTaskIsSeenAgain) {
  for (const auto& [task, from, to, speed] :
       {SeenAgain{{"palpation", "--preset", "prostate"}},
        SeenAgain{{"search", "--mode", "augmented"}}, SeenAgain{{"squeeze"}},
        SeenAgain{{"friction"}}, SeenAgain{{"friction", "--sort"}},
        SeenAgain{{"pulse"}, "20", "30", "10"}}) {  // it takes minutes: a second is not seen
    const Folder here;
    std::vector<std::string> arguments = task;
    arguments.insert(arguments.end(),
                     {"--operator", "expert", "--seed", "3", "--trials", "1", "--out", "A"});
    ASSERT_EQ(palpa(quickly(arguments), here.path()).exit_code, 0) << task[0];
    const Outcome outcome = palpa({"replay", "A/session.palpa", "--video", "a.avi", "--from", from,
                                   "--to", to, "--speed", speed, "--size", "320x240"},
                                  here.path());
    ASSERT_EQ(outcome.exit_code, 0) << task[0] << outcome.err;
    const std::vector<cv::Mat> frames = framesOf(here / "a.avi");
    ASSERT_EQ(frames.size(), 25u) << task[0];
    cv::Mat difference;
    cv::absdiff(frames.front(), frames.back(), difference);
    EXPECT_GT(cv::norm(difference, cv::NORM_L1) / static_cast<double>(difference.total()), 0.1)
        << task[0];
    EXPECT_GT(playedColumns(frames.back()), playedColumns(frames.front()) + 3) << task[0];
    EXPECT_EQ(palpa({"replay", "A/session.palpa", "--video", "b.avi", "--trial", "7"}, here.path())
                  .exit_code,
              2)
        << task[0];
  }
}

TEST(ReplayView, WrongWishesAreNamed) {
  const auto complains = [](std::vector<std::string> words, const char* about) {
    const Outcome outcome = film(std::move(words));
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
    EXPECT_TRUE(says(outcome.err, about)) << outcome.err;
  };
  complains({"--video", "a.gif"}, ".mp4 or .avi");
  complains({"--video", "c.avi", "--trial", "7"}, "has no trial 7");
  complains({"--video", "c.avi", "--from", "9999"}, "The trial lasts");
  complains({"--video", "c.avi", "--size", "big"}, "1280x720");
  complains({"--video", "c.avi", "--speed", "0"}, "speed");
  complains({"--video", "c.avi", "--from", "nan"}, "--from needs a number of 0 s or more");
  complains({"--video", "c.avi", "--view"}, "do not go together");
  complains({"--video", "c.avi", "--figures", "f"}, "do not go together");
  complains({"--figures", "f"}, "is no search");
  complains({"--from", "1"}, "Add --view");
  EXPECT_FALSE(std::filesystem::exists(recordedNeedle() / "c.avi"));
}

TEST(ReplayView, WithoutADisplayTheWindowIsRefusedInWords) {
  const Outcome outcome = film({"--view"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
}

}  // namespace
}  // namespace palpa::cli_test
