#include "apps/report/page/pictures.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/report/page/small_picture.h"
#include "synthetic_report.h"
#include "tests/support/base64.h"

/// Pictures on a page that is mailed.
namespace palpa::report {
namespace {

using namespace test;
namespace fs = std::filesystem;

/// A real PNG: one grey pixel.
constexpr unsigned char kPixel[] = {0x89, 'P', 'N',  'G',  '\r', '\n', 0x1a, '\n', 0,    0, 0, 13,
                                    'I',  'H', 'D',  'R',  0,    0,    0,    1,    0,    0, 0, 1,
                                    8,    0,   0,    0,    0,    0x3a, 0x7e, 0x9b, 0x55, 0, 0, 0,
                                    10,   'I', 'D',  'A',  'T',  0x78, 0x9c, 0x63, 0x68, 0, 0, 0,
                                    0x82, 0,   0x81, 0x77, 0xcd, 0x72, 0xb6, 0,    0,    0, 0, 'I',
                                    'E',  'N', 'D',  0xae, 0x42, 0x60, 0x82};

bool shows(const std::string& page, const std::string& text) {
  return page.find(text) != std::string::npos;
}

std::vector<uchar> bytesIn(const std::string& text) { return {text.begin(), text.end()}; }

TEST(Pictures, EmbedsPicturesAndNamesLostOnes) {
  SessionReport report = syntheticReport(1);
  const fs::path folder = freshFolder("pictures");
  std::ofstream(folder / "view-1.png", std::ios::binary)
      .write(reinterpret_cast<const char*>(kPixel), sizeof(kPixel));
  std::ofstream(folder / "letter.png") << "no picture";
  report.trials[0].pictures = {{folder / "view-1.png", "Vein entered", 26.2},
                               {folder / "letter.png", "Lung touched", 18.3},
                               {folder / "gone.png", "Success", -1}};
  writeReport(report, folder / "report.html");
  const std::string page = slurp(folder / "report.html");
  EXPECT_TRUE(shows(page, "data:image/webp;base64,UklGR"));  // RIFF
  EXPECT_TRUE(shows(page, "letter.png could not be read"));
  EXPECT_TRUE(shows(page, "gone.png could not be read"));
  EXPECT_FALSE(shows(page, folder.string()));  // a page says nothing of folders
}

/// A session of hours has a thousand pictures: the page would have a gigabyte.
TEST(Pictures, ShowsPicturesFromBesideItWhereItIsLarge) {
  const fs::path folder = freshFolder("large");
  std::ofstream(folder / "view-1.png", std::ios::binary)
      .write(reinterpret_cast<const char*>(kPixel), sizeof(kPixel));
  const std::vector<Picture> pictures{{folder / "view-1.png", "Vein entered", 26.2}};
  Html page;
  page.element("p", "Whatever a page says besides does not count.");
  writePictures(page, pictures);
  EXPECT_TRUE(shows(page.str(), "data:image/webp;base64,UklGR"));
  EXPECT_FALSE(shows(page.str(), "src=\"view-1.png\""));
  Html larger;
  larger.countPicture(kCarried);
  writePictures(larger, pictures);
  EXPECT_FALSE(shows(larger.str(), "<img")) << "a page that was mailed has no files beside it";
  EXPECT_FALSE(shows(larger.str(), "data:image"));
  EXPECT_TRUE(shows(larger.str(), "view-1.png"));
  EXPECT_TRUE(shows(larger.str(), "files in the session"));
}

/// Of every size what fits into a share of the page: those of the first trials are the largest.
TEST(Pictures, PicturesAreAsLargeAsFits) {
  const fs::path folder = freshFolder("sizes");
  cv::Mat grain(360, 640, CV_8UC3);
  cv::randn(grain, 128, 12);
  cv::imwrite((folder / "grain.png").string(), grain);
  const std::vector<Picture> pictures(3, {folder / "grain.png", "Grain", 0});
  Html page;
  int widest = 640;
  for (int trial = 0; trial < 6; ++trial) {
    const std::size_t before = page.pictureBytes(), from = page.str().size();
    writePictures(page, pictures);
    EXPECT_LE(page.pictureBytes() - before, (kCarried - before) / 4) << trial;
    const std::string part = page.str().substr(from), sign = "base64,";
    const std::size_t at = part.find(sign);
    if (at == std::string::npos) {
      EXPECT_TRUE(shows(part, "grain.png"));
      continue;
    }
    const std::string coded = part.substr(at + sign.size(), part.find('"', at) - at - sign.size());
    const cv::Mat shown = cv::imdecode(bytesIn(palpa::test::fromBase64(coded)), cv::IMREAD_COLOR);
    EXPECT_LE(shown.cols, widest) << trial;
    EXPECT_NEAR(shown.rows, shown.cols * 9 / 16, 1) << trial;
    widest = shown.cols;
  }
  EXPECT_LT(widest, 640) << "the last trials had less room";
}

/// The same picture, only smaller: each pixel the mean of those it stands for, give or take the
/// coding.
TEST(Pictures, ASmallPictureIsTheLargeOne) {
  cv::Mat large(360, 640, CV_8UC3);
  for (int y = 0; y < large.rows; ++y)
    for (int x = 0; x < large.cols; ++x)
      large.at<cv::Vec3b>(y, x) = cv::Vec3b(cv::saturate_cast<uchar>(x * 255 / 640),
                                            cv::saturate_cast<uchar>(y * 255 / 360), 90);
  std::vector<uchar> png;
  cv::imencode(".png", large, png);
  const SmallPicture picture(std::string(png.begin(), png.end()));
  ASSERT_TRUE(picture.isThere());
  EXPECT_EQ(picture.wide(), 640);
  for (const int wide : {1000, 640, 320, 100}) {
    const std::string bytes = picture.webp(wide);
    const cv::Mat small = cv::imdecode(bytesIn(bytes), cv::IMREAD_COLOR);
    ASSERT_EQ(small.cols, std::min(wide, 640));
    cv::Mat wanted;
    cv::resize(large, wanted, small.size(), 0, 0, cv::INTER_AREA);
    EXPECT_LT(cv::norm(small, wanted, cv::NORM_L1) / static_cast<double>(3 * small.total()), 4)
        << wide;
  }
  EXPECT_FALSE(SmallPicture("no picture").isThere());
  EXPECT_FALSE(SmallPicture(std::string(png.begin(), png.begin() + 60)).isThere());
}

}  // namespace
}  // namespace palpa::report
