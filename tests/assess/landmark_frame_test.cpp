#include "anatomy/patient.h"

#include <gtest/gtest.h>

#include <limits>

#include "anatomy/base/error.h"

namespace palpa::anatomy {
namespace {

Vec3 mirrored(const Vec3& v) { return {-v.x(), v.y(), v.z()}; }

/// An oblique clavicle: rising and running backward to the shoulder, as in life.
Patient rightSide() {
  Patient patient;
  patient.landmarks[landmark::kAcromialEnd] = {-0.15, 0.05, 0.03};
  patient.landmarks[landmark::kSternalEnd] = {-0.01, 0.01, 0.0};
  patient.landmarks[landmark::kMedialThird] = {-0.055, 0.02, 0.012};
  return patient;
}

Patient leftSide() {
  Patient patient = rightSide();
  patient.side = Side::left;
  for (auto& [key, p] : patient.landmarks) p = mirrored(p);
  return patient;
}

TEST(LandmarkFrame, AxesPointMediallyPosteriorlyAndCephalad) {
  for (const Patient& patient : {rightSide(), leftSide()}) {
    const LandmarkFrame frame(patient);
    const Vec3 chord =
        (patient.landmarks.at(landmark::kSternalEnd) - patient.landmarks.at(landmark::kAcromialEnd))
            .normalized();
    EXPECT_LT((frame.vectorToA(Vec3::UnitX()) - chord).norm(), 1e-15);
    EXPECT_GT(frame.vectorToA(Vec3::UnitY()).y(), 0.9);
    EXPECT_GT(frame.vectorToA(Vec3::UnitZ()).z(), 0.9);
    EXPECT_NEAR(frame.vectorToLandmarks(patient.landmarks.at(landmark::kMedialThird)).norm(),
                patient.landmarks.at(landmark::kMedialThird).norm(), 1e-15);
    EXPECT_LT(frame.pointToLandmarks(patient.landmarks.at(landmark::kMedialThird)).norm(), 1e-15);
  }
}

TEST(LandmarkFrame, RightIsRightHandedLeftIsItsMirror) {
  const auto handedness = [](const LandmarkFrame& f) {
    return f.vectorToA(Vec3::UnitX())
        .cross(f.vectorToA(Vec3::UnitY()))
        .dot(f.vectorToA(Vec3::UnitZ()));
  };
  EXPECT_NEAR(handedness(LandmarkFrame(rightSide())), 1, 1e-15);
  EXPECT_NEAR(handedness(LandmarkFrame(leftSide())), -1, 1e-15);
}

TEST(LandmarkFrame, MirroredPatientAndMotionGiveTheSameBits) {
  const LandmarkFrame right(rightSide()), left(leftSide());
  for (const Vec3& p : {Vec3(-0.07, -0.01, 0.02), Vec3(0.3, 0.2, -0.1), Vec3(0, 0, 0)}) {
    EXPECT_EQ(right.pointToLandmarks(p), left.pointToLandmarks(mirrored(p)));
    EXPECT_EQ(right.vectorToLandmarks(p), left.vectorToLandmarks(mirrored(p)));
    EXPECT_EQ(mirrored(right.pointToA(p)), left.pointToA(p));
  }
}

TEST(LandmarkFrame, RoundTrips) {
  const LandmarkFrame frame(leftSide());
  const Vec3 p(0.02, -0.03, 0.01);
  EXPECT_LT((frame.pointToA(frame.pointToLandmarks(p)) - p).norm(), 1e-16);
  EXPECT_LT((frame.vectorToA(frame.vectorToLandmarks(p)) - p).norm(), 1e-16);
}

TEST(LandmarkFrame, RefusesWhatTellsNoDirection) {
  Patient patient = rightSide();
  patient.landmarks[landmark::kAcromialEnd] = patient.landmarks[landmark::kSternalEnd];
  EXPECT_THROW(LandmarkFrame{patient}, Error);
  patient = rightSide();
  patient.landmarks.erase(landmark::kMedialThird);
  EXPECT_THROW(LandmarkFrame{patient}, Error);
  patient = rightSide();
  patient.landmarks[landmark::kMedialThird].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(LandmarkFrame{patient}, Error);
  patient = rightSide();
  patient.landmarks[landmark::kAcromialEnd] = {-0.01, 0.01, 0.15};  // along the body
  EXPECT_THROW(LandmarkFrame{patient}, Error);
  patient.landmarks[landmark::kAcromialEnd] = {-0.01, 0.15, 0.0};  // straight to the back
  EXPECT_THROW(LandmarkFrame{patient}, Error);
}

}  // namespace
}  // namespace palpa::anatomy
