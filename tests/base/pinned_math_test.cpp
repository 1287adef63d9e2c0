#include "anatomy/base/pinned_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>

#include "anatomy/base/pinned_tables.h"
#include "anatomy/base/random.h"

/// Against the C library's functions of 64 bits of mantissa, whose own error is below 0.001 of the
/// units here. Bounds are those that the header states.
namespace palpa::pinned {
namespace {

constexpr int kArguments = 200'000;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Error of `value` in units of the last place of what it should be.
double errorOf(double value, long double truth) {
  int exponent = 0;
  std::frexp(static_cast<double>(truth), &exponent);
  const long double unit = std::ldexp(1.0L, std::max(exponent - 53, -1074));
  return static_cast<double>(std::fabs((static_cast<long double>(value) - truth) / unit));
}

/// Where arguments are drawn: evenly, or so that every power of two is as likely as another.
struct Range {
  double low, high;
  bool of_powers = false;
  double draw(RandomStream& random) const {
    const double u = random.uniform(low, high);
    if (!of_powers) return u;
    const double size = std::exp2(u);
    return random.bits() & 1 ? size : -size;
  }
};

using Function = std::function<double(double)>;
using Truth = std::function<long double(long double)>;

double largestError(const Function& f, const Truth& truth, const Range& range) {
  RandomStream random(1, "pinned");
  double largest = 0;
  for (int i = 0; i < kArguments; ++i) {
    const double x = range.draw(random);
    largest = std::max(largest, errorOf(f(x), truth(static_cast<long double>(x))));
  }
  return largest;
}

struct Case {
  const char* name;
  Function f;
  Truth truth;
  Range range;
  double bound;  ///< units of the last place
};

TEST(PinnedMath, IsAsExactAsItSays) {
  const auto l = [](long double (*f)(long double)) { return Truth(f); };
  for (const Case& c : std::initializer_list<Case>{
           {"exp", exp, l(::expl), {-708, 709}, 0.6},
           {"exp", exp, l(::expl), {-60, 3, true}, 0.6},
           {"expm1", expm1, l(::expm1l), {-60, 5.4, true}, 1},
           {"expm1", expm1, l(::expm1l), {-2, 2}, 1},
           {"log", log, l(::logl), {0, 4}, 0.6},
           {"log1p", log1p, l(::log1pl), {-50, -0.1, true}, 1.5},
           {"log1p", log1p, l(::log1pl), {-0.999, 4}, 1.5},
           {"tanh", tanh, l(::tanhl), {-30, 5, true}, 2.5},
           {"erfc", erfc, l(::erfcl), {-3, 26}, 30},
           {"sin", sin, l(::sinl), {-10, 10}, 0.9},
           {"sin", sin, l(::sinl), {-40, 62, true}, 0.9},
           {"cos", cos, l(::cosl), {-10, 10}, 0.9},
           {"cos", cos, l(::cosl), {-40, 62, true}, 0.9},
           {"tan", tan, l(::tanl), {-40, 40, true}, 2.5},
           {"asin", asin, l(::asinl), {-1, 1}, 2.5},
           {"asin", asin, l(::asinl), {-40, 0, true}, 2.5},
           {"acos", acos, l(::acosl), {-1, 1}, 2.5},
           {"atan", atan, l(::atanl), {-40, 40, true}, 1.5},
           {"atan", atan, l(::atanl), {-2, 2}, 1.5},
       })
    EXPECT_LE(largestError(c.f, c.truth, c.range), c.bound)
        << c.name << " from " << c.range.low << " to " << c.range.high;
}

TEST(PinnedMath, OfTwoArgumentsAsWell) {
  for (const double y : {0.3, 1.3, 1 / 1.3, -2.7, 77.3, 1e-5, 300.0}) {
    const auto power = [&](double x) { return pow(x, y); };
    const auto truth = [&](long double x) { return ::powl(x, static_cast<long double>(y)); };
    EXPECT_LE(largestError(power, truth, {0.1, 10}), 0.6) << y;
    const auto angle = [&](double x) { return atan2(x, -y); };
    const auto its = [&](long double x) { return ::atan2l(x, static_cast<long double>(-y)); };
    EXPECT_LE(largestError(angle, its, {-20, 20, true}), 1.5) << y;
    const auto length = [&](double x) { return hypot(x, y); };
    const auto whole = [&](long double x) { return ::hypotl(x, static_cast<long double>(y)); };
    EXPECT_LE(largestError(length, whole, {-20, 20, true}), 1.5) << y;
  }
}

/// Zeros, infinities, no numbers, the smallest, the largest, and what leaves the domain: as the C
/// library has it, sign of zero included.
constexpr double kSpecial[] = {0.0,
                               -0.0,
                               1,
                               -1,
                               kInfinite,
                               -kInfinite,
                               std::numeric_limits<double>::quiet_NaN(),
                               5e-324,
                               -5e-324,
                               1e-310,
                               std::numeric_limits<double>::min(),
                               std::numeric_limits<double>::max(),
                               -std::numeric_limits<double>::max(),
                               0.5,
                               -0.5,
                               2,
                               -2,
                               3,
                               -3,
                               1e300,
                               -1e300,
                               0x1p53,
                               0x1p53 + 2,
                               1e22,
                               709.9,
                               710,
                               -745.2,
                               -750,
                               2.5};

/// Equal, or as near as roundings bring them.
bool agree(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  if (std::signbit(a) != std::signbit(b)) return false;
  if (a == b) return true;
  const auto apart = std::bit_cast<std::int64_t>(a) - std::bit_cast<std::int64_t>(b);
  return std::isfinite(a) && std::isfinite(b) && a != 0 && b != 0 && std::abs(apart) <= 40;
}

using One = double (*)(double);
using Two = double (*)(double, double);

TEST(PinnedMath, KnowsTheEdges) {
  const std::pair<One, One> pairs[] = {{exp, std::exp},     {expm1, std::expm1}, {log, std::log},
                                       {log1p, std::log1p}, {sin, std::sin},     {cos, std::cos},
                                       {tan, std::tan},     {tanh, std::tanh},   {asin, std::asin},
                                       {acos, std::acos},   {atan, std::atan},   {erfc, std::erfc}};
  for (const auto& [ours, theirs] : pairs)
    for (const double x : kSpecial)
      EXPECT_TRUE(agree(ours(x), theirs(x))) << "function " << &ours - &pairs[0].first << " of "
                                             << x << ": " << ours(x) << ", not " << theirs(x);
}

TEST(PinnedMath, KnowsTheEdgesOfTwoArguments) {
  const std::pair<Two, Two> pairs[] = {{pow, std::pow}, {atan2, std::atan2}, {hypot, std::hypot}};
  for (const auto& [ours, theirs] : pairs)
    for (const double x : kSpecial)
      for (const double y : kSpecial)
        EXPECT_TRUE(agree(ours(x, y), theirs(x, y)))
            << x << ", " << y << ": " << ours(x, y) << ", not " << theirs(x, y);
}

/// Of any bits: a number of any size, of any sign, or none.
TEST(PinnedMath, KnowsArgumentsOfEverySize) {
  RandomStream random(2, "pinned");
  for (int i = 0; i < kArguments; ++i) {
    const auto x = std::bit_cast<double>(random.bits()), y = std::bit_cast<double>(random.bits());
    EXPECT_TRUE(agree(sin(x), std::sin(x))) << x;
    EXPECT_TRUE(agree(cos(x), std::cos(x))) << x;
    EXPECT_TRUE(agree(exp(x), std::exp(x))) << x;
    EXPECT_TRUE(agree(log(x), std::log(x))) << x;
    EXPECT_TRUE(agree(pow(x, y), std::pow(x, y))) << x << ", " << y;
    EXPECT_TRUE(agree(atan2(x, y), std::atan2(x, y))) << x << ", " << y;
    EXPECT_TRUE(agree(hypot(x, y), std::hypot(x, y))) << x << ", " << y;
  }
}

TEST(PinnedMath, IsExactWhereItCanBe) {
  EXPECT_EQ(exp(0), 1);
  EXPECT_EQ(log(1), 0);
  EXPECT_EQ(cos(0), 1);
  EXPECT_EQ(pow(2, 10), 1024);
  EXPECT_EQ(pow(9, 0.5), 3);
  EXPECT_EQ(hypot(3, 4), 5);
  EXPECT_EQ(atan2(0, -1), 0x1.921fb54442d18p1);
  EXPECT_EQ(atan2(1, 1), 0x1.921fb54442d18p-1);
}

/// What they are, on this computer and every other: whoever changes the functions changes the
/// forces of all that is recorded.
TEST(PinnedMath, HasTheseBits) {
  std::uint64_t all = 0;
  const auto add = [&](double value) {
    all = mixedBits(all ^ std::bit_cast<std::uint64_t>(value));
  };
  for (int i = 1; i <= 5000; ++i) {
    const double x = i * 0.00137, u = x / 7;
    for (const One f : {exp, expm1, log, log1p, tanh, erfc, sin, cos, tan, atan}) add(f(x));
    add(asin(u)), add(acos(u));
    add(pow(x, 1.3)), add(atan2(x, 1.7)), add(hypot(x, 0.9)), add(sin(1e9 * x));
  }
  EXPECT_EQ(all, 0x2988152fa8daa32eull);
}

TEST(PinnedTables, HoldWhatTheySay) {
  for (int i = 0; i < 128; ++i) {
    const tables::Root& root = tables::kRoots[static_cast<std::size_t>(i)];
    const long double value = std::exp2(static_cast<long double>(i) / 128);
    EXPECT_EQ(root.value, static_cast<double>(value)) << i;
    EXPECT_NEAR(root.rest, static_cast<double>(value / root.value - 1), 0x1p-62) << i;
    const tables::Reciprocal& r = tables::kReciprocals[static_cast<std::size_t>(i)];
    const long double log = -std::log(static_cast<long double>(r.inverse));
    EXPECT_EQ(r.high * 0x1p42, std::trunc(r.high * 0x1p42)) << i;
    EXPECT_NEAR(r.low, static_cast<double>(log - r.high), 0x1p-63) << i;
  }
  for (int i = 0; i <= 32; ++i) {
    const tables::Angle& a = tables::kAngles[static_cast<std::size_t>(i)];
    const long double angle = std::atan(static_cast<long double>(i) / 32);
    EXPECT_EQ(a.high, static_cast<double>(angle)) << i;
    EXPECT_NEAR(a.low, static_cast<double>(angle - a.high), 0x1p-63) << i;
  }
}

}  // namespace
}  // namespace palpa::pinned
