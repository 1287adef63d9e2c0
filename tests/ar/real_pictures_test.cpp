#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <regex>
#include <vector>

#include "ar/cameras/recorded_pictures.h"
#include "ar/tracking/board_pose.h"
#include "tests/support/test_data.h"

namespace palpa::ar {
namespace {

namespace fs = std::filesystem;

TEST(RealChessboard, EveryViewIsFoundAndFitsBelowHalfAPixel) {
  const fs::path folder = testData("chessboard");
  PALPA_NEED_DATA(folder);
  const auto camera = calibration::readCameraModel(folder / "left_intrinsics.yml");
  const auto board = makeBoard("chessboard:9x6:0.025");
  ImageSequence sequence((folder / "left*.jpg").string(), 15);
  int found = 0;
  double worst = 0;
  while (const auto frame = sequence.grab()) {
    const auto pose = estimateBoardPose(board->detect(frame->image), camera);
    ASSERT_TRUE(pose) << frame->source;
    EXPECT_EQ(pose->points, 54) << frame->source;
    EXPECT_LT(pose->rms_px, 0.5) << frame->source;
    EXPECT_GT(pose->X_CW.inverse().translation().z(), 0.2)
        << frame->source;  // held at 0.3 to 0.5 m
    worst = std::max(worst, pose->rms_px);
    ++found;
  }
  EXPECT_EQ(found, 13);
  RecordProperty("worst_rms_px", std::to_string(worst));
}

struct TrueTag {
  int id;
  std::array<Eigen::Vector2d, 4> corners;  ///< the library's order and frame: centres at .5
};

std::vector<TrueTag> readTruth(const fs::path& file) {
  const std::regex number(R"(-?\d+\.?\d*)");
  std::vector<TrueTag> tags;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::vector<double> values;
    for (std::sregex_iterator it(line.begin(), line.end(), number), end; it != end; ++it)
      values.push_back(std::stod(it->str()));
    if (values.size() != 9) continue;
    TrueTag tag{int(values[0]), {}};
    for (std::size_t i = 0; i < 4; ++i) tag.corners[i] = {values[1 + 2 * i], values[2 + 2 * i]};
    tags.push_back(tag);
  }
  return tags;
}

/// Largest distance between corners of equal number, in OpenCV's frame.
double distance(const Tag& seen, const TrueTag& truth) {
  double largest = 0;
  for (std::size_t i = 0; i < 4; ++i)
    largest = std::max(largest,
                       (seen.corners[i] - (truth.corners[i] - Eigen::Vector2d(0.5, 0.5))).norm());
  return largest;
}

void expectTags(const std::string& name, int expected, double worst_allowed) {
  const fs::path photo = testData("apriltag/photos/" + name + ".jpg");
  PALPA_NEED_DATA(photo);
  fs::path text = photo;
  const std::vector<TrueTag> truth = readTruth(text.replace_extension(".txt"));
  const std::vector<Tag> seen = detectTags(cv::imread(photo.string(), cv::IMREAD_GRAYSCALE));
  std::vector<bool> used(truth.size(), false);
  int matched = 0;
  for (const Tag& tag : seen) {  // every tag claimed must be a true one, each true one once
    double best = 1e9;
    std::size_t which = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
      if (!used[i] && truth[i].id == tag.id && distance(tag, truth[i]) < best)
        best = distance(tag, truth[which = i]);
    EXPECT_LT(best, worst_allowed) << name << " id " << tag.id;
    if (best >= worst_allowed) continue;
    used[which] = true;
    ++matched;
  }
  EXPECT_GE(matched, expected);
  EXPECT_EQ(std::size_t(matched), seen.size()) << "tags that are not there";
}

// Corners of these photographs agree with their published truth to 0.67, 0.82 and 2.35 px.
TEST(RealTags, TwelveOnTheCourt) { expectTags("33369213973_9d9bb4cc96_c", 12, 2.5); }
TEST(RealTags, TwentyFourInTheDistance) { expectTags("34085369442_304b6bafd9_c", 24, 2.5); }
TEST(RealTags, TenAtClose) { expectTags("34139872896_defdb2f8d9_c", 10, 2.5); }

}  // namespace
}  // namespace palpa::ar
