#include "calibration/touch/object_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anatomy/base/random.h"
#include "tests/support/complaint.h"
#include "tests/support/counts.h"

/// A map learnt from touches, judged by shapes that no Gaussian process drew: hard cores, ribs, a
/// slope from soft to hard.
namespace palpa::calibration {
namespace {

using Eigen::Vector2d;

constexpr double kHalf = 0.04, kNoise = 0.02;

double bump(double away, double wide) { return std::exp(-away * away / (2 * wide * wide)); }

double core(const Vector2d& p) {
  return 500 * (1 + 0.8 * bump((p - Vector2d(0.012, -0.008)).norm(), 0.009));
}
double ribs(const Vector2d& p) {
  return 500 * (1 + bump(p.y() - 0.015, 0.008) + bump(p.y() + 0.018, 0.008));
}
double slope(const Vector2d& p) { return 400 * (1 + 0.6 / (1 + std::exp(-p.x() / 0.015))); }

struct Thing {
  const char* name;
  double (*stiffness)(const Vector2d&);
};
constexpr Thing kThings[] = {{"core", core}, {"ribs", ribs}, {"slope", slope}};

MappedArea wholeArea() {
  MappedArea area;
  area.low = Vector2d::Constant(-kHalf);
  area.high = Vector2d::Constant(kHalf);
  return area;
}

class Toucher {
 public:
  Toucher(const Thing& thing, std::uint64_t seed)
      : thing_(thing), random_(seed, "object_map_test") {}
  Vector2d somewhere() {
    return {kHalf * (2 * random_.uniform() - 1), kHalf * (2 * random_.uniform() - 1)};
  }
  TouchedPlace touch(const Vector2d& p) {
    return {p, std::log(thing_.stiffness(p)) + kNoise * random_.normal(), kNoise};
  }
  /// In rows, as hands go, not evenly.
  std::vector<TouchedPlace> rows(int each) {
    std::vector<TouchedPlace> touches;
    const double step = 2 * kHalf / each;
    for (int i = 0; i < each * each; ++i) {
      const Vector2d even(-kHalf + (i % each + 0.5) * step, -kHalf + (i / each + 0.5) * step);
      touches.push_back(touch(even + 0.15 * step * Vector2d(random_.normal(), random_.normal())));
    }
    return touches;
  }

 private:
  const Thing& thing_;
  RandomStream random_;
};

TEST(ObjectMap, KnowsTheThingAndHowWellItKnowsIt) {
  const int seeds = palpa::test::counted(8, 200), places = 20;
  for (const Thing& thing : kThings) {
    int covered = 0, near = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
      Toucher hand(thing, static_cast<std::uint64_t>(seed));
      const ObjectMap map(hand.rows(10));
      for (int i = 0; i < places; ++i) {
        const Vector2d p = hand.somewhere();
        const MapValue v = map.at(p);
        const double truth = thing.stiffness(p);
        covered += v.low <= truth && truth <= v.high;
        near += std::abs(v.value / truth - 1) <= 0.1;
      }
    }
    const double all = seeds * places;
    EXPECT_GE(near / all, 0.95) << thing.name;
    // of few seeds a share of 0.95 is 0.95 +- 0.035 (two sd of 160)
    EXPECT_GE(covered / all, palpa::test::fullCounts() ? 0.92 : 0.89) << thing.name;
    EXPECT_LE(covered / all, palpa::test::fullCounts() ? 0.98 : 1.0) << thing.name;
  }
}

TEST(ObjectMap, SaysWhereItKnowsLeastAndIsSureInTheEnd) {
  Toucher hand(kThings[0], 1);
  std::vector<TouchedPlace> touches;
  for (const TouchedPlace& touch : hand.rows(9))
    if ((touch.at - Vector2d(0.02, 0.02)).norm() > 0.015) touches.push_back(touch);
  MapVerdict verdict = judge(ObjectMap(touches), wholeArea());
  EXPECT_LT((verdict.next.front() - Vector2d(0.02, 0.02)).norm(), 0.01) << "the gap";
  for (int i = 0; i < 60 && !verdict.sure; ++i) {
    touches.push_back(hand.touch(verdict.next.front()));
    verdict = judge(ObjectMap(touches), wholeArea());
  }
  EXPECT_TRUE(verdict.sure) << verdict.known;
}

TEST(ObjectMap, IsTheSameInOtherUnitsAndTurnedRound) {
  Toucher hand(kThings[1], 2);
  const std::vector<TouchedPlace> touches = hand.rows(7);
  std::vector<TouchedPlace> other = touches;
  for (TouchedPlace& touch : other)
    touch = {Vector2d(-touch.at.y(), touch.at.x()), touch.ln + std::log(1e-3), touch.sd};
  const ObjectMap map(touches), turned(other);
  for (const Vector2d& p : {Vector2d(0, 0), Vector2d(0.021, -0.013), Vector2d(0.06, 0.06)}) {
    const MapValue a = map.at(p), b = turned.at({-p.y(), p.x()});
    EXPECT_NEAR(b.value / a.value, 1e-3, 1e-9);
    EXPECT_NEAR(b.sd, a.sd, 1e-9);
  }
  EXPECT_GT(map.at({0.2, 0.2}).sd, 3 * map.at({0, 0}).sd) << "far away it knows little";
}

TEST(ObjectMap, RefusesWhatTellsNothing) {
  Toucher hand(kThings[0], 3);
  std::vector<TouchedPlace> touches = hand.rows(3);
  const auto refusal = [](const std::vector<TouchedPlace>& all) {
    return palpa::test::complaint([&] { const ObjectMap map(all); });
  };
  EXPECT_TRUE(palpa::test::says(refusal({touches.begin(), touches.begin() + 5}), "5 touches"));
  EXPECT_TRUE(palpa::test::says(refusal(std::vector<TouchedPlace>(9, touches[0])), "one place"));
  touches[4].sd = 0;
  EXPECT_TRUE(palpa::test::says(refusal(touches), "says nothing"));
}

}  // namespace
}  // namespace palpa::calibration
