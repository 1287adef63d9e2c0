#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "program.h"
#include "tests/support/test_data.h"

/// Sessions on recorded pictures: drawn ones for the mistakes, real ones for the numbers.
namespace palpa::cli_test {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

constexpr const char* kIntrinsics = R"(%YAML:1.0
---
image_width: 640
image_height: 480
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 600., 0., 320., 0., 600., 240., 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ 0., 0., 0., 0., 0. ]
)";

class Pictures : public testing::Test {
 protected:
  void SetUp() override {
    here.file("camera.yml", kIntrinsics);
    const cv::Mat grey(480, 640, CV_8UC1, cv::Scalar(128));
    ASSERT_TRUE(cv::imwrite((here / "a.jpg").string(), grey));
  }
  void expectRefused(const Arguments& more, const std::string& word) {
    const std::vector<std::string> before = here.files();
    Arguments all = session(more);
    all.insert(all.end(), {"--out", "results"});
    const Outcome outcome = palpa(all, here.path());
    EXPECT_TRUE(outcome.exit_code == 1 || outcome.exit_code == 2) << outcome.exit_code;
    EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(word), std::string::npos)
        << "wanted " << word << ": " << outcome.err;
    EXPECT_EQ(here.files(), before);
  }
  Arguments with(const std::string& glob, const std::string& camera, const std::string& spec) {
    return {"--camera", glob, "--intrinsics", camera, "--board", spec};
  }
  Folder here;
  const std::string board = "chessboard:9x6:0.025";
};

TEST_F(Pictures, IntrinsicsMissingOrDamaged) {
  expectRefused(with("*.jpg", "nowhere.yml", board), "nowhere.yml");
  here.file("half.yml", std::string(kIntrinsics).substr(0, 120));
  expectRefused(with("*.jpg", "half.yml", board), "half.yml");
  here.file("empty.yml", "");
  expectRefused(with("*.jpg", "empty.yml", board), "empty.yml");
}

TEST_F(Pictures, NoneMatchesOrOneIsTruncated) {
  expectRefused(with("none*.jpg", "camera.yml", board), "none*.jpg");
  here.file("cut-1.jpg", contentOf(here / "a.jpg").substr(0, 300));
  expectRefused(with("cut-*.jpg", "camera.yml", board), "cut-1.jpg");
  const std::string whole = contentOf(here / "a.jpg");
  here.file("most-1.jpg", whole.substr(0, whole.size() - 100));  // decoders would fill it with grey
  expectRefused(with("most-*.jpg", "camera.yml", board), "most-1.jpg");
  here.file("empty-1.png", "");
  expectRefused(with("empty-*.png", "camera.yml", board), "empty-1.png");
  here.file("text-1.png", "not a picture");
  expectRefused(with("text-*.png", "camera.yml", board), "text-1.png");
}

TEST_F(Pictures, FilmsThatAreNone) {
  expectRefused(with("nowhere.mp4", "camera.yml", board), "nowhere.mp4");
  for (const char* name : {"words.avi", "words.mp4", "words.mjpeg"}) {
    here.file(name, "these are words");
    expectRefused(with(name, "camera.yml", board), name);
  }
  here.file("cut.mjpeg", contentOf(here / "a.jpg").substr(0, 200));
  expectRefused(with("cut.mjpeg", "camera.yml", board), "cut.mjpeg");
}

TEST_F(Pictures, OfAnotherSizeThanTheIntrinsics) {
  ASSERT_TRUE(
      cv::imwrite((here / "small-1.png").string(), cv::Mat(240, 320, CV_8UC1, cv::Scalar(128))));
  expectRefused(with("small-*.png", "camera.yml", board), "320x240");
}

TEST_F(Pictures, BoardThatIsNotKnown) {
  for (const char* spec :
       {"carpet", "chessboard:9x6", "chessboard:0x6:0.025", "tags:6x4:0.030:-1", "tags:::", ""})
    expectRefused(with("*.jpg", "camera.yml", spec), "board");
}

TEST_F(Pictures, RealChessboardIsRegisteredInEveryPicture) {
  const fs::path folder = testData("chessboard");
  PALPA_NEED_DATA(folder);
  Arguments all = session(
      with((folder / "left*.jpg").string(), (folder / "left_intrinsics.yml").string(), board));
  all.insert(all.end(), {"--out", "A"});
  const Outcome outcome = palpa(all, here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream lines(contentOf(here / "A/registration.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line.rfind("picture,found,points,rms_px", 0), 0u) << line;
  int pictures = 0;
  while (std::getline(lines, line)) {
    std::string name, found, points, rms;
    std::istringstream row(line);
    std::getline(row, name, ',');
    std::getline(row, found, ',');
    std::getline(row, points, ',');
    std::getline(row, rms, ',');
    EXPECT_EQ(found, "1") << line;
    EXPECT_EQ(points, "54") << line;  // 9 x 6 inner corners
    EXPECT_LT(std::stod(rms), 0.5) << line;
    ++pictures;
  }
  EXPECT_EQ(pictures, 13);
}

}  // namespace
}  // namespace palpa::cli_test
