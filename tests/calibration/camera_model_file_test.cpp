#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>
#include <random>

#include "anatomy/base/error.h"
#include "calibration/camera_model.h"
#include "tests/calibration/sample_cameras.h"
#include "tests/support/test_data.h"

namespace palpa::calibration {
namespace {

namespace fs = std::filesystem;

class CameraFile : public testing::Test {
 protected:
  CameraFile() : folder_(fs::temp_directory_path() / ("palpa_camera_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~CameraFile() override { fs::remove_all(folder_); }

  fs::path put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  /// What the reader says about such a file; "" when it accepts it. Anything else it throws fails.
  std::string complaint(const std::string& name, const std::string& text) const {
    try {
      readCameraModel(put(name, text));
      return "";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
      return error.what();
    }
  }

  fs::path folder_;
};

std::string slurp(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// As OpenCV's own calibration writes it.
std::string opencvText(const CameraModel& camera, const std::string& extension,
                       int coefficients = 5) {
  cv::FileStorage out(extension, cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  cv::Mat k = cv::Mat::zeros(coefficients, 1, CV_64F);
  for (int i = 0; i < std::min(coefficients, 5); ++i)
    k.at<double>(i) = camera.distortion[std::size_t(i)];
  out << "image_width" << camera.width << "image_height" << camera.height << "camera_matrix"
      << cv::Mat(cv::Matx33d(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1))
      << "distortion_coefficients" << k << "avg_reprojection_error" << camera.rms_px;
  return out.releaseAndGetString();
}

/// A number as this version of OpenCV writes it into a matrix.
std::string opencvNumber(double value) {
  cv::FileStorage out(".yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  out << "m" << cv::Mat(cv::Matx<double, 1, 1>(value));
  const std::string text = out.releaseAndGetString();
  const std::size_t at = text.find("[ ") + 2;
  return text.substr(at, text.find(" ]") - at);
}

void expectSame(const CameraModel& a, const CameraModel& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.fx, b.fx);
  EXPECT_EQ(a.fy, b.fy);
  EXPECT_EQ(a.cx, b.cx);
  EXPECT_EQ(a.cy, b.cy);
  EXPECT_EQ(a.distortion, b.distortion);
  EXPECT_EQ(a.rms_px, b.rms_px);
}

TEST_F(CameraFile, JsonRoundTripsToTheLastBit) {
  for (CameraModel camera : sampleCameras()) {
    camera.fx += 1.0 / 3;
    writeCameraModel(camera, folder_ / "camera.json");
    expectSame(readCameraModel(folder_ / "camera.json"), camera);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1)
      << "something was left beside it";
}

TEST_F(CameraFile, ReadsWhatOpenCvWrites) {
  const CameraModel camera = sampleCameras()[1];
  expectSame(readCameraModel(put("a.yml", opencvText(camera, ".yml"))), camera);
  expectSame(readCameraModel(put("a.xml", opencvText(camera, ".xml"))), camera);
}

TEST_F(CameraFile, TakesFourCoefficientsAndLongerOnesThatAreZero) {
  CameraModel camera = sampleCameras()[2];
  expectSame(readCameraModel(put("8.yml", opencvText(camera, ".yml", 8))), camera);
  camera.distortion[4] = 0;
  expectSame(readCameraModel(put("4.yml", opencvText(camera, ".yml", 4))), camera);
}

TEST_F(CameraFile, SaysWhichLensModelsAreNotSupported) {
  const CameraModel camera = sampleCameras()[0];
  const std::string rational =
      replaced(opencvText(camera, ".yml", 8), "0., 0., 0. ]", "0., 0., 0.1 ]");
  EXPECT_NE(complaint("rational.yml", rational).find("rational"), std::string::npos);
  EXPECT_NE(complaint("six.yml", opencvText(camera, ".yml", 6)).find("4 or 5"), std::string::npos);
  const std::string fisheye = opencvText(camera, ".yml") + "fisheye_model: 1\n";
  EXPECT_NE(complaint("fisheye.yml", fisheye).find("fisheye"), std::string::npos);
  const std::string equidistant = opencvText(camera, ".yml") + "distortion_model: equidistant\n";
  EXPECT_NE(complaint("equidistant.yml", equidistant).find("fisheye"), std::string::npos);
}

TEST_F(CameraFile, NamesTheFieldThatIsWrong) {
  CameraModel camera = sampleCameras()[1];
  camera.fx = 500.5;
  camera.cx = 301.25;
  const std::string good = opencvText(camera, ".yml");
  ASSERT_EQ(complaint("good.yml", good), "");
  const std::string fx = opencvNumber(camera.fx), cx = opencvNumber(camera.cx),
                    k1 = opencvNumber(camera.distortion[0]);
  const struct {
    std::string from, to, named;
  } damages[] = {{"image_width: 640", "image_width: 0", "image_width"},
                 {"image_width: 640", "image_width: 640.5", "image_width"},
                 {"image_width: 640", "image_width: 123456789", "image_width"},
                 {"image_height: 480", "image_height: -480", "image_height"},
                 {"image_height: 480", "height: 480", "image_height"},
                 {"camera_matrix", "matrix", "camera_matrix"},
                 {"rows: 3", "rows: 2", "camera_matrix"},
                 {"rows: 3", "rows: 1000000000", "camera_matrix"},
                 {"rows: 3", "rows: many", "camera_matrix.rows"},
                 {"cols: 3", "cols: -3", "camera_matrix"},
                 {fx + ", 0.,", fx + ", 1.,", "skew"},
                 {fx, "0.", "fx"},
                 {fx, "-5e+02", "fx"},
                 {fx, ".Nan", "fx"},
                 {fx, ".Inf", "fx"},
                 {fx, "five", "camera_matrix.data"},
                 {cx, "9e9", "cx"},
                 {"distortion_coefficients", "distortion", "distortion_coefficients"},
                 {k1, ".Nan", "distortion_coefficients"},
                 {k1, "-40.", "distortion_coefficients"},
                 {"avg_reprojection_error: ", "avg_reprojection_error: -", "reprojection error"}};
  for (const auto& damage : damages) {
    const std::string said = complaint("bad.yml", replaced(good, damage.from, damage.to));
    EXPECT_NE(said.find(damage.named), std::string::npos)
        << damage.from << " -> " << damage.to << ": '" << said << "'";
  }
}

TEST_F(CameraFile, NamesTheFieldThatIsWrongInJson) {
  writeCameraModel(sampleCameras()[0], folder_ / "good.json");
  const std::string good = slurp(folder_ / "good.json");
  const struct {
    const char *from, *to, *named;
  } damages[] = {{"\"version\": 1", "\"version\": 2", "version"},
                 {"\"type\": \"camera_model\"", "\"type\": \"station\"", "type"},
                 {"\"unit\": \"px\"", "\"unit\": \"mm\"", "unit"},
                 {"\"width\": 640", "\"width\": 4294967936", "width"},  // 640 in 32 bits
                 {"\"width\": 640", "\"width\": \"640\"", "width"},
                 {"\"fx\": 600.0", "\"fx\": null", "fx"},
                 {"\"fx\": 600.0", "\"f\": 600.0", "fx"},
                 {"\"distortion\": [", "\"distortion\": [1, 2, ", "distortion"},
                 {"\"distortion\": [", "\"distortion\": [\"a\", ", "distortion"}};
  for (const auto& damage : damages) {
    const std::string said = complaint("bad.json", replaced(good, damage.from, damage.to));
    EXPECT_NE(said.find(damage.named), std::string::npos) << damage.to << ": '" << said << "'";
  }
}

TEST_F(CameraFile, RefusesWhatIsNoCalibration) {
  EXPECT_NE(complaint("empty.yml", ""), "");
  EXPECT_NE(complaint("blank.yml", " \n\n"), "");
  EXPECT_NE(complaint("text.yml", "fx = 600\n"), "");
  EXPECT_NE(complaint("nul.yml", std::string("%YAML:1.0\n---\na: \0 1\n", 20)), "");
  EXPECT_NE(complaint("list.yml", "%YAML:1.0\n---\n- 1\n- 2\n"), "");
  EXPECT_NE(complaint("array.json", "[1, 2]"), "");
  EXPECT_THROW(readCameraModel(folder_), Error);
  EXPECT_THROW(readCameraModel(folder_ / "absent.yml"), Error);
}

TEST_F(CameraFile, WhatIsNestedDeepEndsNoReader) {
  constexpr std::size_t kDeep = 100'000;
  std::string tags;
  for (std::size_t i = 0; i < kDeep; ++i) tags += "<a>";
  for (const auto& [name, text] :
       {std::pair<std::string, std::string>{"deep.yml",
                                            "%YAML:1.0\n---\na: " + std::string(kDeep, '[')},
        {"deep.xml", "<?xml version=\"1.0\"?>\n<opencv_storage>" + tags + "</opencv_storage>"}})
    EXPECT_NE(complaint(name, text).find("is nested too deep"), std::string::npos) << name;
}

/// Cut anywhere, or with any byte changed: accepted or refused in our words, nothing else.
TEST_F(CameraFile, DamageNeverLeaksAnotherException) {
  writeCameraModel(sampleCameras()[1], folder_ / "whole.json");
  const std::string whole[] = {opencvText(sampleCameras()[1], ".yml"),
                               opencvText(sampleCameras()[1], ".xml"),
                               slurp(folder_ / "whole.json")};
  std::mt19937 random(5);
  for (const std::string& text : whole) {
    for (std::size_t length = 0; length + 60 < text.size(); length += 3)
      EXPECT_NE(complaint("cut", text.substr(0, length)), "") << length << " of " << text.size();
    for (int i = 0; i < 200; ++i) {
      std::string changed = text;
      changed[random() % text.size()] = char(random() % 256);
      complaint("changed", changed);
    }
  }
}

TEST_F(CameraFile, AFailedWriteLeavesTheOldFileAlone) {
  const CameraModel camera = sampleCameras()[0];
  writeCameraModel(camera, folder_ / "camera.json");
  CameraModel broken = camera;
  broken.fx = std::nan("");
  EXPECT_THROW(writeCameraModel(broken, folder_ / "camera.json"), Error);
  expectSame(readCameraModel(folder_ / "camera.json"), camera);
  EXPECT_THROW(writeCameraModel(camera, folder_ / "no_such_folder" / "camera.json"), Error);
  fs::create_directory(folder_ / "taken.json");
  EXPECT_THROW(writeCameraModel(camera, folder_ / "taken.json"), Error);
  for (const auto& entry : fs::directory_iterator(folder_))
    EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
}

TEST(RealCamera, IntrinsicsOfTheChessboardPictures) {
  const fs::path file = testData("chessboard/left_intrinsics.yml");
  PALPA_NEED_DATA(file);
  const CameraModel camera = readCameraModel(file);
  EXPECT_EQ(camera.width, 640);
  EXPECT_NEAR(camera.fx, 535.916, 5e-4);  // as printed with the pictures
  EXPECT_NEAR(camera.cx, 342.283, 5e-4);
  EXPECT_NEAR(camera.cy, 235.571, 5e-4);
  EXPECT_NEAR(camera.rms_px, 0.393, 5e-4);
  for (int u = 0; u <= 640; u += 64)
    for (int v = 0; v <= 480; v += 48) {
      const Eigen::Vector2d pixel(u, v);
      EXPECT_LT((camera.project(camera.unproject(pixel)) - pixel).norm(), 1e-10);
    }
}

}  // namespace
}  // namespace palpa::calibration
