#include "haptics/materials/texture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include "anatomy/base/random.h"
#include "haptics/modulation/touch_augmentation.h"
#include "haptics/safety/safety_limiter.h"

/// The laws of a rendered texture: still and lifted tools feel none of it, it is bounded, always
/// stable, as strong as its models, and the same whenever it is computed again.
namespace palpa::haptics {
namespace {

constexpr double kStep = 1e-3;

/// Drawn models over 0.3 to 2 N and 0.03 to 0.24 m/s, some of them close to ringing for ever.
TextureLaw drawn(std::uint64_t seed, double rms, double closest = 0.99) {
  RandomStream random(seed, "texture_test");
  TextureLaw law;
  law.speeds = kMostTextureSpeeds;
  law.forces = kMostTextureForces;
  law.order = kMostTextureOrder;
  law.largest = 1e6;
  for (std::size_t v = 0; v < law.speeds; ++v)
    law.ln_speed[v] = std::log(0.03) + static_cast<double>(v) * std::log(8.0) / 7;
  for (std::size_t f = 0; f < law.forces; ++f) {
    law.ln_force[f] = std::log(0.3) + static_cast<double>(f) * std::log(20.0 / 3) / 3;
    for (std::size_t v = 0; v < law.speeds; ++v) {
      law.nodes[f][v].ln_rms = std::log(rms);
      for (double& k : law.nodes[f][v].reflection) k = random.uniform(-closest, closest);
    }
  }
  return law;
}

std::vector<double> slide(const TextureLaw& law, double f_n, double speed, int ticks) {
  TextureState state;
  std::vector<double> w;
  for (int i = 0; i < ticks; ++i)
    w.push_back(textureForce(law, f_n, Vec3(speed * kStep, 0, 0), kStep, &state));
  return w;
}

double rmsOf(const std::vector<double>& w, std::size_t from) {
  double squares = 0;
  for (std::size_t i = from; i < w.size(); ++i) squares += w[i] * w[i];
  return std::sqrt(squares / static_cast<double>(w.size() - from));
}

TEST(Texture, NoneWithoutContactMotionOrModels) {
  const TextureLaw law = drawn(1, 0.1);
  EXPECT_EQ(rmsOf(slide(law, 0, 0.1, 500), 0), 0);
  EXPECT_EQ(rmsOf(slide(law, -1, 0.1, 500), 0), 0);
  EXPECT_EQ(rmsOf(slide(law, 1, 0, 500), 0), 0);
  EXPECT_EQ(rmsOf(slide(law, 1, 0.9 * kTextureStill, 500), 0), 0);
  EXPECT_EQ(rmsOf(slide({}, 1, 0.1, 500), 0), 0);
  EXPECT_GT(rmsOf(slide(law, 1, 0.1, 500), 0), 0);
}

TEST(Texture, EndsWithTheContactInTheSameTick) {
  const TextureLaw law = drawn(2, 0.1);
  TextureState state;
  for (int i = 0; i < 300; ++i) textureForce(law, 1, Vec3(1e-4, 0, 0), kStep, &state);
  const std::uint32_t noise = state.noise;
  EXPECT_EQ(textureForce(law, 0, Vec3(1e-4, 0, 0), kStep, &state), 0);
  EXPECT_EQ(state.noise, noise);
  EXPECT_EQ(state.slow_f_n, 0);
  for (const double b : state.backward) EXPECT_EQ(b, 0);
}

/// With the speed, through its low-pass: within the first 10 ms it has a third of its strength.
TEST(Texture, FadesIn) {
  const TextureLaw law = drawn(3, 0.1, 0.3);
  const std::vector<double> w = slide(law, 0.3, 0.03, 4000);
  EXPECT_LT(rmsOf({w.begin(), w.begin() + 5}, 0), 0.3 * rmsOf(w, 1000));
}

TEST(Texture, FallsToNothingBelowItsFirstForceAndSpeed) {
  const TextureLaw law = drawn(4, 0.1, 0.5);
  const double full = rmsOf(slide(law, 0.3, 0.03, 8991), 800);
  EXPECT_NEAR(rmsOf(slide(law, 0.15, 0.03, 8991), 800), full / 2, 1e-3 * full);
  EXPECT_NEAR(rmsOf(slide(law, 0.3, 0.0175, 8991), 800), full / 2, 1e-3 * full);
}

/// Over a whole turn of the register the noise has the same power at every one of its lines, 0.12
/// Hz apart, so the force's strength is the model's where no resonance is as narrow as that: of 48
/// drawn coefficients within 0.3 some ring for as long as a turn.
TEST(Texture, IsAsStrongAsItsModel) {
  constexpr int kSettled = 10'000, kTurn = 8191;
  for (std::uint64_t seed = 10; seed < 14; ++seed) {
    const TextureLaw law = drawn(seed, 0.1, 0.2);
    const double rms = textureRms(law.nodes[1][3]);
    const std::vector<double> w =
        slide(law, std::exp(law.ln_force[1]), std::exp(law.ln_speed[3]), kSettled + kTurn);
    EXPECT_NEAR(rmsOf(w, kSettled), rms, 0.005 * rms) << seed;
  }
}

TEST(Texture, IsStableAndBoundedBetweenModelsThatHardlyAre) {
  for (std::uint64_t seed = 20; seed < 30; ++seed) {
    TextureLaw law = drawn(seed, 0.1, 0.9999);
    RandomStream random(seed, "texture_test_motion");
    TextureState state;
    double most = 0;
    for (int i = 0; i < 20'000; ++i) {
      const double f_n = random.uniform(0.01, 3), speed = random.uniform(0, 0.4);
      most = std::max(most,
                      std::abs(textureForce(law, f_n, Vec3(speed * kStep, 0, 0), kStep, &state)));
    }
    // the lattice's states lose what is not put in: |y| stays below the square root of its order
    // and the noise of a tick, times two by the difference
    EXPECT_LT(most, 0.1 * 2 * std::sqrt(kMostTextureOrder + 1.0) * 10) << seed;
    law.largest = 0.05;
    EXPECT_LE(std::abs(textureForce(law, 1, Vec3(1e-4, 0, 0), kStep, &state)), 0.05);
  }
}

TEST(Texture, IsTheSameBitsAgain) {
  const TextureLaw law = drawn(31, 0.1);
  const std::vector<double> once = slide(law, 0.7, 0.08, 3000), again = slide(law, 0.7, 0.08, 3000);
  EXPECT_EQ(std::memcmp(once.data(), again.data(), once.size() * sizeof(double)), 0);
}

TEST(Texture, WhatIsNoNumberGivesNone) {
  const TextureLaw law = drawn(32, 0.1);
  TextureState state;
  const double nan = std::nan("");
  EXPECT_EQ(textureForce(law, nan, Vec3(1e-4, 0, 0), kStep, &state), 0);
  EXPECT_EQ(textureForce(law, 1, Vec3(nan, 0, 0), kStep, &state), 0);
  EXPECT_EQ(textureForce(law, 1, Vec3(1e-4, 0, 0), 0, &state), 0);
  TextureLaw damaged = law;
  damaged.order = 1000;
  EXPECT_EQ(textureForce(damaged, 1, Vec3(1e-4, 0, 0), kStep, &state), 0);
}

/// On any steady force, a texture of the largest size passes the limiter as it is, at every
/// frequency.
TEST(Texture, LargestPassesTheSlewLimit) {
  const SafetyLimits limits;
  for (const double f_Hz : {20.0, 100.0, 400.0, 499.0}) {
    for (const Vec3& steady : {Vec3(0, 0, 0), Vec3(0, 0, 3), Vec3(2, 1, 0.5)}) {
      SafetyState state;
      SafetyInput in;
      in.armed = true;
      for (int i = 0; i < 2000; ++i) {
        in.now_ns = 1'000'000 * (i + 1);
        in.sequence = static_cast<std::uint64_t>(i + 1);
        in.f_wanted_D = steady + Vec3(0, 0,
                                      largestTexture(limits.max_slew_N_per_s) *
                                          std::sin(2 * std::numbers::pi * f_Hz * i * kStep));
        const Vec3 f = limitForce(limits, state, in);
        if (i > 5) {
          ASSERT_EQ((f - in.f_wanted_D).norm(), 0) << f_Hz << " Hz, tick " << i;
        }
      }
    }
  }
}

/// Along the normal that is found, as a part of what the device gives, and named as a source.
TEST(Texture, IsAddedAlongTheNormal) {
  TouchAugmentation law;
  law.surface.contact.real = {500, 5, 1.3};
  law.surface.contact.friction = law.surface.wanted = {0.3, 1000, 0.1};
  TouchAugmentation plain = law;
  law.texture = drawn(33, 0.1);
  TouchAugmentationState state, without;
  double most = 0;
  for (int i = 0; i < 500; ++i) {
    const ToolTouch tool{true, Vec3(1e-4 * i, 0, 0), Vec3(-0.3, 0, 1), 1};
    const AugmentedTouch now = augmentTouch(law, {}, {tool, {}}, kStep, &state),
                         was = augmentTouch(plain, {}, {tool, {}}, kStep, &without);
    EXPECT_NEAR((now.f_d[0] - was.f_d[0] - now.f_source[0]).norm(), 0, 1e-12);
    EXPECT_NEAR(now.f_source[0].cross(now.touch[0].u_n).norm(), 0, 1e-12);
    EXPECT_EQ(was.f_source[0].norm(), 0);
    most = std::max(most, now.f_source[0].norm());
  }
  EXPECT_GT(most, 0.01);
}

}  // namespace
}  // namespace palpa::haptics
