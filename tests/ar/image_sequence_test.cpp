#include "ar/cameras/recorded_pictures.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "anatomy/base/error.h"

namespace palpa::ar {
namespace {

namespace fs = std::filesystem;

class Sequence : public testing::Test {
 protected:
  Sequence() : folder_(fs::temp_directory_path() / ("palpa_sequence_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~Sequence() override { fs::remove_all(folder_); }

  void put(const std::string& name, int tone, cv::Size size = {64, 48}, int type = CV_8U) const {
    cv::imwrite((folder_ / name).string(), cv::Mat(size, type, cv::Scalar::all(tone)));
  }
  std::string glob(const std::string& pattern) const { return (folder_ / pattern).string(); }

  static std::string complaint(ImageSequence* sequence) {
    try {
      sequence->grab();
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  }

  fs::path folder_;
};

TEST_F(Sequence, YieldsThePicturesByNameWithTheirTimes) {
  for (const int i : {3, 1, 10, 2}) put(cv::format("view%02d.png", i), 10 * i);
  put("other.png", 200);
  ImageSequence sequence(glob("view*.png"), 30);
  std::vector<int> tones;
  std::uint64_t number = 0;
  while (const auto frame = sequence.grab()) {
    EXPECT_EQ(frame->number, number);
    EXPECT_EQ(frame->t_exposure_ns, std::llround(double(number) * 1e9 / 30));
    EXPECT_EQ(frame->source, sequence.files()[number].string());
    EXPECT_EQ(frame->image.type(), CV_8UC1);
    tones.push_back(frame->image.at<unsigned char>(5, 5));
    ++number;
  }
  EXPECT_EQ(tones, (std::vector<int>{10, 20, 30, 100}));
  EXPECT_FALSE(sequence.grab());
}

TEST_F(Sequence, MakesEightBitsOfDeeperPictures) {
  put("deep.png", 0x4040, {64, 48}, CV_16U);
  put("rgba.png", 90, {64, 48}, CV_8UC4);
  ImageSequence sequence(glob("*.png"), 15);
  EXPECT_EQ(sequence.grab()->image.type(), CV_8UC1);
  EXPECT_EQ(sequence.grab()->image.type(), CV_8UC3);
}

TEST_F(Sequence, RefusesAnEmptyPatternAndAnImpossibleRate) {
  put("a.png", 1);
  EXPECT_THROW(ImageSequence(glob("*.jpg"), 15), Error);
  EXPECT_THROW(ImageSequence(folder_.string(), 15), Error);
  EXPECT_THROW(ImageSequence("", 15), Error);
  for (const double fps : {0.0, -15.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW(ImageSequence(glob("*.png"), fps), UsageError);
}

TEST_F(Sequence, NamesThePictureThatFails) {
  put("1.png", 1);
  put("2.png", 2);
  put("3.png", 3, {80, 48});
  std::ofstream(folder_ / "4.png") << "no picture";
  std::ofstream(folder_ / "5.png") << "";
  ImageSequence sequence(glob("*.png"), 15);
  EXPECT_EQ(complaint(&sequence), "");
  fs::rename(folder_ / "2.png", folder_ / "2.away");
  const std::string gone = complaint(&sequence);
  EXPECT_NE(gone.find("2.png"), std::string::npos);
  EXPECT_NE(gone.find("gone"), std::string::npos);
  fs::rename(folder_ / "2.away", folder_ / "2.png");
  EXPECT_EQ(complaint(&sequence), "");  // a failure loses nothing
  const std::string size = complaint(&sequence);
  EXPECT_NE(size.find("3.png"), std::string::npos);
  EXPECT_NE(size.find("80x48"), std::string::npos);
}

TEST_F(Sequence, NamesTheUnreadablePicture) {
  for (const char* text : {"no picture", "", "\x89PNG\r\n\x1a\n"}) {
    std::ofstream(folder_ / "bad.png", std::ios::binary) << text;
    ImageSequence sequence(glob("*.png"), 15);
    EXPECT_NE(complaint(&sequence).find("bad.png"), std::string::npos);
  }
}

}  // namespace
}  // namespace palpa::ar
