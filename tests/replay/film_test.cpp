#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "anatomy/base/error.h"
#include "apps/replay/film.h"
#include "apps/replay/needle_replay.h"
#include "tests/support/files.h"

namespace palpa::replay {
namespace {

scene::Image plain(int width, int height, std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  scene::Image image{width, height, 3, {}};
  for (int i = 0; i < width * height; ++i)
    image.pixels.insert(image.pixels.end(), {red, green, blue});
  return image;
}

TEST(Film, IsThereWholeWithEveryPictureInItsColours) {
  for (const char* name : {"a.avi", "a.mp4"}) {
    const auto folder = palpa::test::freshFolder("replay", name);
    Film film(folder / name, 25, 160, 120);
    for (int i = 0; i < 30; ++i)
      film.add(plain(160, 120, i < 15 ? 200 : 20, 40, i < 15 ? 20 : 200));
    EXPECT_FALSE(std::filesystem::exists(folder / name)) << "before it is finished";
    film.finish();
    cv::VideoCapture again((folder / name).string());
    ASSERT_TRUE(again.isOpened()) << name;
    EXPECT_EQ(again.get(cv::CAP_PROP_FRAME_WIDTH), 160);
    EXPECT_NEAR(again.get(cv::CAP_PROP_FPS), 25, 1e-6);
    cv::Mat picture;
    int frames = 0;
    for (; again.read(picture); ++frames) {
      const cv::Vec3b bgr = picture.at<cv::Vec3b>(60, 80);
      EXPECT_NEAR(bgr[2], frames < 15 ? 200 : 20, 25) << name << ' ' << frames;
    }
    EXPECT_EQ(frames, 30) << name;
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1)
        << "nothing beside";
  }
}

TEST(Film, WhatIsNotFinishedLeavesNothing) {
  const auto folder = palpa::test::freshFolder("replay", "unfinished");
  { Film(folder / "a.avi", 25, 160, 120).add(plain(160, 120, 1, 2, 3)); }
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST(Film, WrongWishesAreNamed) {
  auto folder = palpa::test::freshFolder("replay", "wrong");
  EXPECT_THROW(codecOf("a.gif"), UsageError);
  EXPECT_THROW(Film(folder / "no" / "such" / "a.avi", 25, 160, 120), Error);
  Film film(folder / "a.avi", 25, 160, 120);
  EXPECT_THROW(film.add(plain(100, 100, 0, 0, 0)), Error);
}

/// Three JPEGs one after the other, of which each is a brightness of its own.
std::filesystem::path threePictures() {
  auto folder = palpa::test::freshFolder("replay", "pictures");
  std::ofstream film(folder / "camera.mjpeg", std::ios::binary), table(folder / "camera.mjpeg.csv");
  table << "number,t_exposure_ns,source\n";
  for (int i = 0; i < 3; ++i) {
    std::vector<unsigned char> jpeg;
    cv::imencode(".jpg", cv::Mat(48, 64, CV_8UC3, cv::Scalar(20 + 90 * i, 10, 10)), jpeg);
    film.write(reinterpret_cast<const char*>(jpeg.data()),
               static_cast<std::streamsize>(jpeg.size()));
    table << i << ',' << 1000 * (i + 1) << ",x\n";
  }
  return folder;
}

TEST(RecordedPictures, TheLastOneTakenIsShownWhicheverWayOneCame) {
  RecordedPictures pictures(threePictures());
  ASSERT_FALSE(pictures.empty());
  EXPECT_EQ(pictures.at(999), nullptr);
  for (const auto& [t_ns, blue] : {std::pair{1000, 20}, {2500, 110}, {99999, 200}, {1999, 20}}) {
    const scene::Image* image = pictures.at(t_ns);
    ASSERT_NE(image, nullptr);
    EXPECT_EQ(image->width, 64);
    EXPECT_NEAR(image->pixels[3 * (24 * 64 + 32) + 2], blue, 6) << t_ns;
  }
}

TEST(RecordedPictures, WhatIsMissingOrCutShortIsLeftOut) {
  EXPECT_TRUE(RecordedPictures(palpa::test::freshFolder("replay", "none")).empty());
  const auto folder = threePictures();
  std::filesystem::resize_file(folder / "camera.mjpeg",
                               std::filesystem::file_size(folder / "camera.mjpeg") / 2);
  RecordedPictures cut(folder);
  EXPECT_NE(cut.at(1000), nullptr);
  cut.at(99999);  // whatever it is, it does not fail
  std::filesystem::resize_file(folder / "camera.mjpeg", 0);
  EXPECT_TRUE(RecordedPictures(folder).empty());
}

}  // namespace
}  // namespace palpa::replay
