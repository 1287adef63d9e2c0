#include "apps/station/calibration_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "a_calibration.h"
#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/sha256.h"
#include "tests/support/counts.h"
#include "tests/support/damage.h"
#include "tests/support/scratch_folder.h"

namespace palpa::station {
namespace {

using palpa::test::says;
using test::aCalibration;

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

std::string whyRefused(const std::filesystem::path& file) {
  try {
    readCalibration(file);
  } catch (const UsageError&) {
    return "a usage error";
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(CalibrationFile, ReadsBackToTheBit) {
  const test::ScratchFolder folder("calibration_file");
  const CalibrationFile c = aCalibration();
  writeCalibration(c, folder / "tool.json");
  const CalibrationFile read = readCalibration(folder / "tool.json");
  EXPECT_EQ(textOf(read), textOf(c));
  EXPECT_EQ(read.covariance, c.covariance);
  EXPECT_EQ(read.residuals.values, c.residuals.values);
  EXPECT_EQ(read.residuals.left_out, c.residuals.left_out);
  EXPECT_LT((poseAt(read, "X_ET").matrix() - poseAt(c, "X_ET").matrix()).norm(), 1e-15);
  ASSERT_EQ(read.rests_on.size(), 1u);
  EXPECT_EQ(read.rests_on[0].sha256, "abc");
}

TEST(CalibrationFile, KindsRoundTrip) {
  for (int i = 0; i <= static_cast<int>(CalibrationKind::subtasks); ++i) {
    const auto kind = static_cast<CalibrationKind>(i);
    EXPECT_EQ(calibrationKindNamed(nameOf(kind)), kind) << nameOf(kind);
  }
  EXPECT_EQ(nameOf(CalibrationKind::force_sensor), "force-sensor");
  EXPECT_FALSE(calibrationKindNamed("force_sensor"));
}

TEST(CalibrationFile, CameraReadsBack) {
  CalibrationFile c = aCalibration();
  calibration::CameraModel camera{
      640, 480, 602.125, 601.25, 322.5, 237.0625, {-0.21, 0.09, 0.0006, -0.0004, 0.001}, 0};
  c.kind = CalibrationKind::camera;
  c.parameters.clear();
  addCamera(c, camera);
  const calibration::CameraModel read = cameraAt(c);
  EXPECT_EQ(read.fx, camera.fx);
  EXPECT_EQ(read.cy, camera.cy);
  EXPECT_EQ(read.distortion, camera.distortion);
  EXPECT_EQ(read.width, 640);
}

TEST(CalibrationFile, ForeignNewerEditedAndCutFilesAreTold) {
  const test::ScratchFolder folder("calibration_file_bad");
  const std::filesystem::path file = folder / "tool.json";
  const std::string good = textOf(aCalibration());
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    write(file, text);
    return whyRefused(file);
  };
  EXPECT_TRUE(says(replaced("palpa calibration", "another program's"),
                   "is not a calibration made by this program"));
  EXPECT_TRUE(says(replaced("\"version\": 1", "\"version\": 9"), "version"));
  EXPECT_TRUE(says(replaced("\"verdict\": \"pass\"", "\"verdict\": \"good\""), "checksum"));
  EXPECT_TRUE(says(replaced("0.11", "0.12"), "checksum"));
  write(file, good.substr(0, good.size() / 2));
  EXPECT_TRUE(says(whyRefused(file), "not valid JSON"));
  write(file, "");
  EXPECT_TRUE(says(whyRefused(file), "not valid JSON"));
  EXPECT_TRUE(says(whyRefused(folder / "none.json"), "cannot be read"));
}

TEST(CalibrationFile, AFieldOfAnotherTypeIsNamed) {
  const test::ScratchFolder folder("calibration_file_type");
  const std::filesystem::path file = folder / "tool.json";
  nlohmann::json body = parseJson(textOf(aCalibration()));
  body["simulated"] = "no";
  body.erase("sha256");
  body["sha256"] = sha256(body.dump());
  write(file, body.dump());
  EXPECT_TRUE(says(whyRefused(file), "field \"simulated\" must be true or false"))
      << whyRefused(file);
}

TEST(CalibrationFile, ACovarianceOfTooManyNamesTakesNoMemory) {
  const test::ScratchFolder folder("calibration_file_large");
  const std::filesystem::path file = folder / "tool.json";
  nlohmann::json body = parseJson(textOf(aCalibration()));
  const std::size_t many = 200'000;
  body["covariance"] = {{"coordinates", std::vector<std::string>(many, "x")},
                        {"matrix", std::vector<int>(many, 0)}};
  body.erase("sha256");
  body["sha256"] = sha256(body.dump());
  write(file, body.dump());
  EXPECT_TRUE(says(whyRefused(file), "has more than 1000 names")) << whyRefused(file);
}

TEST(CalibrationFile, WhatIsNoResultIsNotWritten) {
  const test::ScratchFolder folder("calibration_file_nan");
  const auto refused = [&](auto spoil) {
    CalibrationFile c = aCalibration();
    spoil(c);
    EXPECT_THROW(writeCalibration(c, folder / "tool.json"), Error);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  };
  refused([](CalibrationFile& c) { c.parameters[0].values[1] = std::nan(""); });
  refused([](CalibrationFile& c) { c.residuals.rms = HUGE_VAL; });
  refused([](CalibrationFile& c) { c.covariance(1, 1) = -1e-9; });
  refused([](CalibrationFile& c) { c.covariance(0, 1) = 1; });
  refused([](CalibrationFile& c) { c.covariance = Eigen::MatrixXd::Identity(3, 3); });
  refused([](CalibrationFile& c) { c.checks[0].value = std::nan(""); });
}

/// Any damage is told in one line that names the file, or leaves what is read as it was (a blank
/// more or less).
TEST(CalibrationFile, DamageIsToldAndNeverBelieved) {
  const test::ScratchFolder folder("calibration_file_damage");
  const std::filesystem::path file = folder / "tool.json";
  const std::string good = textOf(aCalibration());
  test::DamageDice dice(20260301);
  int refused = 0;
  const int cases = test::counted(500, 5000);
  for (int i = 0; i < cases; ++i) {
    std::string text = good;
    for (std::size_t hits = 1 + dice.below(3); hits > 0; --hits) {
      const std::size_t at = dice.below(text.size());
      if (dice.below(4) == 0)
        text.erase(at, 1 + dice.below(40));
      else if (dice.below(4) == 0)
        text.insert(at, text.substr(dice.below(text.size()), dice.below(60)));
      else
        text[at] = static_cast<char>(dice.below(256));
    }
    write(file, text);
    try {
      const CalibrationFile read = readCalibration(file);
      EXPECT_EQ(textOf(read), good) << text;
    } catch (const Error& e) {
      ++refused;
      ASSERT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
      ASSERT_TRUE(says(e.what(), file.string())) << e.what();
    }
  }
  EXPECT_GT(refused, cases / 2);
  test::expectLessThan2GiB();
}

}  // namespace
}  // namespace palpa::station
