#include "anatomy/base/pinned_math.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "anatomy/base/pinned_tables.h"

// Tang, ACM TOMS 15(2), 1989 and 16(4), 1990: a table takes all but a small rest of the argument, a
// short Taylor series the rest. The series end where the next term is below 2^-58 of the result.
namespace palpa::pinned {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeastNormal = std::numeric_limits<double>::min();
constexpr double kWhole = 0x1.8p52;  // added and taken away again: rounds to a whole number

/// exp(x + rest) = 2^power value (1 + share)
struct Power {
  double value, share;
  std::int64_t power;
};

/// For |x| below 2000; `rest` is much smaller than x.
[[gnu::always_inline]] inline Power powerOf(double x, double rest) {
  constexpr double kPerStep = 0x1.71547652b82fep7;  // 128 / ln 2
  constexpr double kStepHigh = 0x1.62e42fef8p-8, kStepLow = 0x1.1cf79abc9e3b4p-43;
  const double shifted = x * kPerStep + kWhole, steps = shifted - kWhole;
  const auto n = std::bit_cast<std::int64_t>(shifted) - std::bit_cast<std::int64_t>(kWhole);
  const tables::Root& root = tables::kRoots[static_cast<std::size_t>(n & 127)];
  const double r = (x - steps * kStepHigh) - steps * kStepLow + rest, r2 = r * r;
  const double share =
      root.rest + r + r2 * (0.5 + r * (1 / 6.0)) + r2 * r2 * (1 / 24.0 + r * (1 / 120.0));
  return {root.value, share, n >> 7};
}

/// Value times 2^power where that is no smaller than the smallest normal number, and finite.
[[gnu::always_inline]] inline double scaled(double value, std::int64_t power) {
  return std::bit_cast<double>(std::bit_cast<std::int64_t>(value) +
                               power * (std::int64_t{1} << 52));
}

[[gnu::always_inline]] inline double valueOf(const Power& p) {
  if (p.power > -960 && p.power < 1023) {  // no product below the normal numbers
    const double scale = scaled(p.value, p.power);
    return scale + scale * p.share;
  }
  return std::ldexp(p.value + p.value * p.share, static_cast<int>(p.power));
}

constexpr double kMostExp = 710, kLeastExp = -746;  // beyond: infinity, zero

[[gnu::always_inline]] inline double expOf(double x, double rest) {
  if (x > kMostExp) return kInfinity;
  if (x < kLeastExp) return 0;
  return valueOf(powerOf(x, rest));
}

/// log(x) = power ln 2 - log(inverse) + log(1 + r), exactly.
struct Split {
  double power, r;
  const tables::Reciprocal* entry;
};

/// Of a positive, finite x.
[[gnu::always_inline]] inline Split splitOf(double x) {
  constexpr std::uint64_t kLowest = 0x3fe6000000000000, kPower = 0xfff0000000000000;  // 0.6875
  double below = 0;
  if (x < kLeastNormal) x *= 0x1p52, below = 52;
  const auto bits = std::bit_cast<std::uint64_t>(x), above = bits - kLowest;
  const auto z_bits = bits - (above & kPower);
  const auto* entry = &tables::kReciprocals[(above >> 45) & 127];
  const double z = std::bit_cast<double>(z_bits),
               z_high = std::bit_cast<double>(z_bits & 0xffffffff00000000);
  Split s;
  s.power = static_cast<double>(static_cast<std::int64_t>(above) >> 52) - below;
  s.entry = entry;
  s.r = (z_high * entry->inverse - 1) + (z - z_high) * entry->inverse;  // every step is exact
  return s;
}

constexpr double kLn2High = 0x1.62e42fefa38p-1, kLn2Low = 0x1.ef35793c7673p-45;

/// (log(1 + r) - r + r^2/2) / r^3, |r| < 2^-7
[[gnu::always_inline]] inline double cubicRest(double r) {
  const double r2 = r * r;
  return (1 / 3.0 - r * (1 / 4.0)) + r2 * (1 / 5.0 - r * (1 / 6.0)) +
         r2 * r2 * ((1 / 7.0 - r * (1 / 8.0)) + r2 * (1 / 9.0));
}

/// A sum of two numbers, the second much smaller.
struct Double2 {
  double high, low;
};

/// To 60 bits. Of a positive, finite x.
[[gnu::always_inline]] inline Double2 logOf(double x) {
  const Split s = splitOf(x);
  const double table = s.power * kLn2High + s.entry->high, first = table + s.r;  // the first exact
  const double low = s.power * kLn2Low + s.entry->low + (table - first + s.r) +
                     s.r * s.r * (s.r * cubicRest(s.r) - 0.5);
  const double high = first + low;
  return {high, first - high + low};
}

/// x of the upper 26 bits: a product of two of them is exact.
double upperHalf(double x) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & 0xfffffffff8000000);
}

[[gnu::always_inline]] inline double powOfPositive(double x, double y) {
  const Double2 l = logOf(x);
  if (std::abs(l.high * y) > 800) return (l.high > 0) == (y > 0) ? kInfinity : 0;
  const double y_high = upperHalf(y), l_high = upperHalf(l.high);
  return expOf(y_high * l_high, (y - y_high) * l_high + y * (l.high - l_high + l.low));
}

bool odd(double y) { return std::abs(y) < 0x1p53 && std::fmod(y, 2) != 0; }

/// Zeros, infinities, NaN, negative x.
double powAtTheEdge(double x, double y) {
  if (y == 0 || x == 1) return 1;
  if (std::isnan(x) || std::isnan(y)) return kNone;
  const double size = std::abs(x);
  if (std::isinf(y)) return size == 1 ? 1 : (size > 1) == (y > 0) ? kInfinity : 0;
  const bool whole = std::trunc(y) == y;
  const double sign = std::signbit(x) && whole && odd(y) ? -1 : 1;
  if (size == 0) return sign * (y > 0 ? 0 : kInfinity);
  if (std::isinf(size)) return sign * (y > 0 ? kInfinity : 0);
  return x < 0 && !whole ? kNone : sign * powOfPositive(size, y);
}

}  // namespace

double exp(double x) { return std::isnan(x) ? x : expOf(x, 0); }

double expm1(double x) {
  constexpr double kSmall = 0.03;  // ten steps of the table
  if (std::abs(x) < kSmall) {
    const double x2 = x * x;
    const double rest = (1 / 6.0 + x * (1 / 24.0)) + x2 * (1 / 120.0 + x * (1 / 720.0)) +
                        x2 * x2 * (1 / 5040.0 + x * (1 / 40320.0));
    return x == 0 ? x : x + x2 * (0.5 + x * rest);
  }
  if (std::isnan(x)) return x;
  if (x < -40) return -1;
  if (x > 40) return expOf(x, 0);
  const Power p = powerOf(x, 0);
  const double scale = scaled(p.value, p.power), rest = scale * p.share, most = scale - 1;
  const double lost = scale > 1 ? (scale - most) - 1 : scale - (most + 1);
  return most + (rest + lost);
}

double log(double x) {
  if (!(x > 0)) return x == 0 ? -kInfinity : kNone;
  if (x == kInfinity) return x;
  const Split s = splitOf(x);
  const double table = s.power * kLn2High + s.entry->high, first = table + s.r;
  const double low = s.power * kLn2Low + s.entry->low + (table - first + s.r);
  return first + (low + s.r * s.r * (s.r * cubicRest(s.r) - 0.5));
}

double log1p(double x) {
  if (!(x > -1)) return x == -1 ? -kInfinity : kNone;
  if (x == kInfinity || std::abs(x) < 0x1p-54) return x;
  const double u = 1 + x, lost = x < 1 ? x - (u - 1) : 1 - (u - x);
  return log(u) + lost / u;
}

double pow(double x, double y) {
  const bool plain = x > 0 && x < kInfinity && std::abs(y) < kInfinity;
  return plain && y != 0 ? powOfPositive(x, y) : powAtTheEdge(x, y);
}

double tanh(double x) {
  const double size = std::abs(x);
  if (std::isnan(x) || size < 0x1p-28) return x;
  if (size > 22) return std::copysign(1.0, x);
  const double grown = expm1(2 * size);
  return std::copysign(size < 0.5 ? grown / (grown + 2) : 1 - 2 / (grown + 2), x);
}

namespace {

/// erf(x) for 0 <= x < 1: Abramowitz and Stegun 7.1.6; all terms are positive.
double erfBelowOne(double x) {
  double term = x, sum = x;
  for (int n = 1; n < 30; ++n) sum += term *= 2 * x * x / (2 * n + 1);
  return 2 * std::numbers::inv_sqrtpi * exp(-x * x) * sum;
}

/// erfc(x) for x >= 1: the continued fraction 7.1.14.
double erfcFromOne(double x) {
  const int terms = static_cast<int>(10 + 200 / (x * x));
  double fraction = x;
  for (int n = terms; n > 0; --n) fraction = x + 0.5 * n / fraction;
  const double x_high = upperHalf(x), rest = (x - x_high) * (x + x_high);  // exp(-x^2) at large x
  return std::numbers::inv_sqrtpi * exp(-x_high * x_high) * exp(-rest) / fraction;
}

}  // namespace

double erfc(double x) {
  if (std::isnan(x)) return x;
  const double size = std::abs(x);
  const double above = size < 1 ? 1 - erfBelowOne(size) : size > 28 ? 0 : erfcFromOne(size);
  return x < 0 ? 2 - above : above;
}

}  // namespace palpa::pinned
