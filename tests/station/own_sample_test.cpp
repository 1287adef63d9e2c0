#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "apps/station/material_files.h"
#include "asset_files.h"

/// What a station's own calibrations of the sample do to the library of lumps.
namespace palpa::station {
namespace {

LumpLibrary library() {
  return readLumps(std::filesystem::path(PALPA_SOURCE_DIR) / "assets/materials/lumps.json");
}

AppliedCalibration calibration(const std::string& kind,
                               std::vector<CalibrationFile::Numbers> parameters,
                               const std::string& date = "2026-03-01T12:30:00Z") {
  AppliedCalibration c;
  c.file.kind = calibrationKindNamed(kind).value();
  c.file.date = date;
  c.file.simulated = true;
  c.file.parameters = std::move(parameters);
  c.path = kind + ".json";
  return c;
}

AppliedCalibration material(double k, double m = 1.5) {
  return calibration("material", {{"k_N_per_m_to_the_m", {k}},
                                  {"b_Ns_per_m_to_the_m_plus_1", {90}},
                                  {"m", {m}},
                                  {"x0_m", {-1e-4}}});
}
AppliedCalibration friction(double mu) {
  return calibration("friction", {{"mu", {mu}}, {"sigma_N_per_m", {700}}, {"B_Ns_per_m", {0.3}}},
                     "2026-04-02T08:00:00Z");
}

TEST(OwnSample, TakesThePlaceOfTheLibrarysInTheLoop) {
  LumpLibrary shipped = library();
  shipped.simulated = false;
  const LumpLibrary own = onStation(shipped, {material(777), friction(0.21)});
  const haptics::TouchAugmentation touch = touchOf(own);
  EXPECT_EQ(touch.surface.contact.real.k, 777);
  EXPECT_EQ(touch.surface.contact.real.b, 90);
  EXPECT_EQ(touch.surface.contact.real.m, 1.5);
  EXPECT_EQ(touch.surface.contact.x0, -1e-4);
  EXPECT_EQ(touch.surface.contact.friction.mu, 0.21);
  EXPECT_EQ(touch.surface.wanted.sigma, 700);
  EXPECT_EQ(touch.kinds[0].H_T.k, touchOf(shipped).kinds[0].H_T.k) << "the lumps stay";
  EXPECT_TRUE(own.simulated);
  EXPECT_EQ(own.of_surface,
            "softness: this station's calibration of 2026-03-01; friction: this station's "
            "calibration of 2026-04-02");
}

TEST(OwnSample, EachByItself) {
  const LumpLibrary shipped = library();
  EXPECT_EQ(onStation(shipped, {}).of_surface, "the library of lumps");
  const LumpLibrary soft = onStation(shipped, {material(777)});
  EXPECT_EQ(soft.surface.k, 777);
  EXPECT_EQ(soft.friction.mu, shipped.friction.mu);
  EXPECT_EQ(soft.of_surface,
            "softness: this station's calibration of 2026-03-01; friction: the library of lumps");
  EXPECT_EQ(onStation(shipped, {friction(0.21)}).surface.k, shipped.surface.k);
}

TEST(OwnSample, ThatNothingSoftCouldBeIsRefused) {
  const LumpLibrary shipped = library();
  EXPECT_THROW(onStation(shipped, {material(-1)}), Error);
  EXPECT_THROW(onStation(shipped, {material(500, 2.5)}), Error);
  EXPECT_THROW(onStation(shipped, {friction(-0.1)}), Error);
}

}  // namespace
}  // namespace palpa::station
