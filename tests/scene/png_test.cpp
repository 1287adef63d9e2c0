#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <filesystem>

#include "tests/scene/offscreen.h"

namespace palpa::scene {
namespace {

namespace fs = std::filesystem;

class Png : public testing::Test {
 protected:
  Png() { fs::create_directories(folder_); }
  ~Png() override { fs::remove_all(folder_); }
  const fs::path folder_ = fs::path(PALPA_BUILD_DIR) / "png_test" /
                           testing::UnitTest::GetInstance()->current_test_info()->name();
};

Image readPng(const fs::path& file) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkImageData* data = reader->GetOutput();
  const int* size = data->GetDimensions();
  Image image{size[0], size[1], data->GetNumberOfScalarComponents(), {}};
  for (int v = 0; v < image.height; ++v) {
    const auto* row =
        static_cast<const std::uint8_t*>(data->GetScalarPointer(0, image.height - 1 - v, 0));
    image.pixels.insert(image.pixels.end(), row, row + image.width * image.channels);
  }
  return image;
}

TEST_F(Png, CapturedFrameComesBackFromTheFileUnchanged) {
  const auto patient = test::simplePatient();
  SceneView view(offscreen(), patient, {320, 240, FixedViews::three, true});
  view.show({});
  const Image frame = view.capture();
  const fs::path file = folder_ / "frame.png";
  writePng(frame, file);
  writePng(frame, file);  // again: replaces
  const Image back = readPng(file);
  EXPECT_EQ(back.width, 320);
  EXPECT_EQ(back.height, 240);
  EXPECT_EQ(back.channels, 3);
  EXPECT_EQ(back.pixels, frame.pixels);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(Png, UnwritablePlaceIsAnErrorThatNamesTheFile) {
  for (const fs::path& file : {folder_ / "missing" / "frame.png", folder_}) {
    try {
      writePng(plain(8, 8, 100), file);
      FAIL() << file;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos);
    }
  }
  EXPECT_TRUE(fs::is_empty(folder_));  // no half-written rest
}

TEST_F(Png, PictureWithoutPixelsIsRefused) {
  EXPECT_THROW(writePng(Image{}, folder_ / "empty.png"), Error);
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace palpa::scene
