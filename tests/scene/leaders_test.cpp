#include "scene/overlay/leaders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

/// Names beside a picture.
namespace palpa::scene {
namespace {

using Eigen::Vector2d;

NameColumns columns() { return {200, 800, 50, 650, 30, 6}; }

std::vector<NamedPlace> somewhere(int count, unsigned seed) {
  std::mt19937 bits(seed);
  std::uniform_real_distribution<double> x(210, 790), y(60, 640);
  std::vector<NamedPlace> places;
  for (int i = 0; i < count; ++i) places.push_back({std::to_string(i), {x(bits), y(bits)}});
  return places;
}

double side(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const Vector2d ab = b - a, ac = c - a;
  return ab.x() * ac.y() - ab.y() * ac.x();
}

TEST(Leaders, NamesKeepApartAndTheirLinesDoNotCross) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const int count = 1 + static_cast<int>(seed % 30);
    const std::vector<PlacedName> placed = placeNames(somewhere(count, seed), columns());
    ASSERT_EQ(placed.size(), static_cast<std::size_t>(count)) << "there is room for all";
    for (const PlacedName& one : placed) {
      EXPECT_GE(one.y, 65);
      EXPECT_LE(one.y, 635);
      EXPECT_EQ(one.x, one.align == Align::right ? 200 : 800);
    }
    for (std::size_t i = 0; i < placed.size(); ++i)
      for (std::size_t j = i + 1; j < placed.size(); ++j) {
        const PlacedName &a = placed[i], &b = placed[j];
        if (a.align != b.align) continue;
        EXPECT_GE(std::abs(a.y - b.y), 30) << seed;
        EXPECT_FALSE(side(a.from, a.of.at, b.from) * side(a.from, a.of.at, b.of.at) < 0 &&
                     side(b.from, b.of.at, a.from) * side(b.from, b.of.at, a.of.at) < 0)
            << seed << ": " << a.of.name << " and " << b.of.name;
      }
  }
}

TEST(Leaders, EachPlaceHasItsNameOnItsSideAtItsHeightWhereItIsAlone) {
  const std::vector<PlacedName> placed =
      placeNames({{"left", {300, 400}}, {"right", {700, 200}}}, columns());
  ASSERT_EQ(placed.size(), 2u);
  EXPECT_EQ(placed[0].of.name, "left");
  EXPECT_EQ(placed[0].align, Align::right);
  EXPECT_EQ(placed[0].y, 400);
  EXPECT_EQ(placed[1].of.name, "right");
  EXPECT_EQ(placed[1].y, 200);
}

TEST(Leaders, WhatHasNoRoomIsLeftOut) {
  EXPECT_EQ(placeNames(somewhere(100, 7), columns()).size(), 40u) << "twenty a column";
  EXPECT_TRUE(placeNames({}, columns()).empty());
}

}  // namespace
}  // namespace palpa::scene
