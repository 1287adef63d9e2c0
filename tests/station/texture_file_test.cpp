#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "anatomy/base/error.h"
#include "apps/station/calibration_file.h"
#include "apps/station/material_files.h"

namespace palpa::station {
namespace {

CalibrationFile written() {
  CalibrationFile file;
  file.kind = CalibrationKind::texture;
  file.station = "test";
  file.date = "2026-03-01T12:30:00Z";
  file.made_by = "test";
  file.valid_days = 1;
  file.parameters = {{"forces_N", {0.5, 1}},
                     {"speeds_m_per_s", {0.05, 0.1}},
                     {"order", {2}},
                     {"leaky_sum_rms_N", {0.1, 0.2, 0.1, 0.2}},
                     {"reflection", {-0.5, 0.1, -0.4, 0.2, -0.3, 0.3, -0.2, 0.4}}};
  file.residuals.unit = "dB";
  file.data.source = "test";
  file.verdict = std::string(kPassed);
  return file;
}

haptics::TextureLaw readBack(const CalibrationFile& file) {
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / "texture_file_test.json";
  writeCalibration(file, path);
  const haptics::TextureLaw law = readTexture(path);
  std::filesystem::remove(path);
  return law;
}

CalibrationFile with(const std::string& name, const std::vector<double>& values) {
  CalibrationFile file = written();
  for (CalibrationFile::Numbers& numbers : file.parameters)
    if (numbers.name == name) numbers.values = values;
  return file;
}

TEST(TextureFile, IsReadBack) {
  const haptics::TextureLaw law = readBack(written());
  ASSERT_EQ(law.forces, 2u);
  ASSERT_EQ(law.speeds, 2u);
  ASSERT_EQ(law.order, 2u);
  EXPECT_NEAR(std::exp(law.ln_force[0]), 0.5, 1e-12);
  EXPECT_NEAR(std::exp(law.ln_speed[1]), 0.1, 1e-12);
  EXPECT_NEAR(std::exp(law.nodes[1][1].ln_rms), 0.2, 1e-12);
  EXPECT_EQ(law.nodes[1][0].reflection[1], 0.3);
}

TEST(TextureFile, RefusesWhatNoTextureHas) {
  EXPECT_THROW(readBack(with("forces_N", {1, 0.5})), Error);
  EXPECT_THROW(readBack(with("speeds_m_per_s", {})), Error);
  EXPECT_THROW(readBack(with("order", {33})), Error);
  EXPECT_THROW(readBack(with("order", {1.5})), Error);
  EXPECT_THROW(readBack(with("leaky_sum_rms_N", {0.1})), Error);
  EXPECT_THROW(readBack(with("leaky_sum_rms_N", {0.1, 0.2, 0, 0.2})), Error);
  EXPECT_THROW(readBack(with("reflection", {-0.5, 0.1, -0.4, 1.2, -0.3, 0.3, -0.2, 0.4})), Error);
  CalibrationFile other = written();
  other.kind = CalibrationKind::friction;
  EXPECT_THROW(readBack(other), Error);
  other = written();
  other.verdict = "is bad";
  EXPECT_THROW(readBack(other), Error);
}

TEST(TextureFile, IsBoundedByTheLimiter) {
  const haptics::TextureLaw law = readBack(written());
  EXPECT_DOUBLE_EQ(bounded(law, 2000, 1000).largest, 0.9);
  EXPECT_THROW(bounded(law, 2000, 2000), UsageError);
  EXPECT_THROW(bounded(law, 200, 1000), UsageError);
  EXPECT_NO_THROW(bounded({}, 200, 4000));
}

}  // namespace
}  // namespace palpa::station
