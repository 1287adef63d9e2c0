#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "anatomy/base/pinned_math.h"
#include "anatomy/base/pinned_tables.h"

// The argument is taken to within pi/4 of a multiple of pi/2 (Cody and Waite; Payne and Hanek for
// large ones), or to within 1/64 of a known arc tangent; a Taylor series does the rest.
namespace palpa::pinned {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr double kHalfPiHigh = 0x1.921fb54442d18p0, kHalfPiLow = 0x1.1a62633145c07p-54;

/// An angle = quarter pi/2 + high + low, modulo 2 pi; |high| is at most about pi/4.
struct Reduced {
  double high, low;
  unsigned quarter;
};

/// Of a finite angle beyond 2^19: its bits times those of 2/pi, without those that make whole
/// turns.
Reduced reducedFar(double size) {
  __extension__ using Wide = unsigned __int128;
  const auto bits = std::bit_cast<std::uint64_t>(size);
  const auto mantissa = (bits & 0xfffffffffffff) | 0x10000000000000;
  const int first = static_cast<int>(bits >> 52) - 1075 + 62;  // bit of the table that counts 2
  const auto word = [&](int i) {
    const auto at = static_cast<std::size_t>(first / 64 + i);
    const int shift = first % 64;
    return shift == 0
               ? tables::kTwoOverPi[at]
               : tables::kTwoOverPi[at] << shift | tables::kTwoOverPi[at + 1] >> (64 - shift);
  };
  const Wide third = Wide{mantissa} * word(2), second = Wide{mantissa} * word(1) + (third >> 64);
  const std::uint64_t top = mantissa * word(0) + static_cast<std::uint64_t>(second >> 64),
                      middle = static_cast<std::uint64_t>(second),
                      last = static_cast<std::uint64_t>(third);
  const std::uint64_t fraction = top << 2 | middle >> 62, below = middle << 2 | last >> 62;
  const auto turned = static_cast<std::int64_t>(fraction);  // of 2^64: from -1/2 to 1/2
  const std::int64_t rough = turned & ~std::int64_t{0x7ff};
  const double high = static_cast<double>(rough) * 0x1p-64;
  const double low =
      static_cast<double>(turned - rough) * 0x1p-64 + static_cast<double>(below) * 0x1p-128;
  const double product = high * kHalfPiHigh;
  const double rest =
      std::fma(high, kHalfPiHigh, -product) + (high * kHalfPiLow + low * kHalfPiHigh);
  const double sum = product + rest;
  return {sum, product - sum + rest, static_cast<unsigned>((top >> 62) + (fraction >> 63))};
}

/// Of a finite angle.
Reduced reduced(double x) {
  constexpr double kPerQuarter = 0x1.45f306dc9c883p-1, kWholeNumber = 0x1.8p52;
  constexpr double kFirst = 0x1.921fb544p0, kSecond = 0x1.0b4611a6p-34,  // of 33 bits each
      kThird = 0x1.3198a2e037073p-69;
  const double size = std::abs(x);
  if (size < 0.785) return {x, 0, 0};
  if (size > 0x1p19) {
    const Reduced far = reducedFar(size);
    return x > 0 ? far : Reduced{-far.high, -far.low, 0u - far.quarter};
  }
  const double n = x * kPerQuarter + kWholeNumber - kWholeNumber;
  const double a = x - n * kFirst, b = n * kSecond, c = n * kThird;
  const double difference = a - b, back = a - difference;
  const double lost = (a - (difference + back)) + (back - b);
  const double high = difference + (lost - c);
  return {high, (difference - high) + (lost - c),
          static_cast<unsigned>(static_cast<std::int64_t>(n))};
}

/// sin(r + rest) for |r| up to pi/4.
double sineNear(double r, double rest) {
  const double s = r * r, s2 = s * s;
  const double series = (-1 / 6.0 + s * (1 / 120.0)) + s2 * (-1 / 5040.0 + s * (1 / 362880.0)) +
                        s2 * s2 *
                            ((-1 / 39916800.0 + s * (1 / 6227020800.0)) +
                             s2 * (-1 / 1307674368000.0 + s * (1 / 355687428096000.0)));
  return r + (r * s * series + rest * (1 - 0.5 * s));
}

/// cos(r + rest) for |r| up to pi/4.
double cosineNear(double r, double rest) {
  const double s = r * r, s2 = s * s, half = 0.5 * s, most = 1 - half;
  const double series = (1 / 24.0 - s * (1 / 720.0)) + s2 * (1 / 40320.0 - s * (1 / 3628800.0)) +
                        s2 * s2 *
                            ((1 / 479001600.0 - s * (1 / 87178291200.0)) +
                             s2 * (1 / 20922789888000.0 - s * (1 / 6402373705728000.0)));
  return most + ((1 - most - half) + (s2 * series - r * rest));
}

double sineOfQuarter(const Reduced& x, unsigned quarter) {
  const double size = quarter & 1 ? cosineNear(x.high, x.low) : sineNear(x.high, x.low);
  return quarter & 2 ? -size : size;
}

/// q + (atan(q) - q) for |q| below 1/16.
double atanRest(double q) {
  const double s = q * q;
  return q * s *
         (-1 / 3.0 +
          s * (1 / 5.0 + s * (-1 / 7.0 + s * (1 / 9.0 + s * (-1 / 11.0 + s * (1 / 13.0))))));
}

struct Arc {
  double high, low;
};

/// atan(y / x) for 0 <= y <= x, x > 0.
Arc arcOf(double y, double x) {
  const double q = y / x;
  if (q < 1 / 16.0) return {q, atanRest(q)};
  const auto i = static_cast<int>(q * 32 + 0.5);
  const double known = i / 32.0, t = (y - known * x) / (x + known * y);
  const tables::Angle& angle = tables::kAngles[static_cast<std::size_t>(i)];
  return {angle.high, t + (atanRest(t) + angle.low)};
}

/// The angle of (x, y) for finite x >= 0, y >= 0, not both zero; on the left, of (-x, y).
double angleOf(double y, double x, bool left) {
  const bool steep = y > x;
  const Arc arc = steep ? arcOf(x, y) : arcOf(y, x);
  if (!steep && !left) return arc.high + arc.low;
  const double quarters = steep ? 1 : 2, sign = steep && left ? 1 : -1;
  const double base = quarters * kHalfPiHigh, with = sign * arc.high;
  const double sum = base + with, lost = with - (sum - base);
  return sum + (lost + (sign * arc.low + quarters * kHalfPiLow));
}

}  // namespace

double sin(double x) {
  if (!(std::abs(x) < kEndless)) return x - x;
  const Reduced r = reduced(x);
  return r.high == 0 ? x : sineOfQuarter(r, r.quarter);
}

double cos(double x) {
  if (!(std::abs(x) < kEndless)) return x - x;
  const Reduced r = reduced(x);
  return sineOfQuarter(r, r.quarter + 1);
}

double tan(double x) {
  if (!(std::abs(x) < kEndless)) return x - x;
  const Reduced r = reduced(x);
  if (r.high == 0) return x;
  const double s = sineNear(r.high, r.low), c = cosineNear(r.high, r.low);
  return r.quarter & 1 ? -c / s : s / c;
}

double atan(double x) { return atan2(x, 1); }

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return x + y;
  double above = std::abs(y), beside = std::abs(x);
  const bool left = std::signbit(x);
  if (above == kEndless || beside == kEndless) {  // of infinities only whether they are
    above = above == kEndless ? 1 : 0;
    beside = beside == kEndless ? 1 : 0;
  }
  if (above == 0) return std::copysign(left ? 2 * kHalfPiHigh : 0.0, y);
  const double scale = above + beside == kEndless ? 0x1p-2 : above < 0x1p-900 ? 0x1p500 : 1;
  above *= scale, beside = std::min(beside * scale, 0x1.fffffffffffffp1023);
  return std::copysign(angleOf(above, beside, left), y);
}

double asin(double x) {
  if (!(std::abs(x) <= 1)) return std::numeric_limits<double>::quiet_NaN();
  return atan2(x, std::sqrt((1 - x) * (1 + x)));
}

double acos(double x) {
  if (!(std::abs(x) <= 1)) return std::numeric_limits<double>::quiet_NaN();
  return atan2(std::sqrt((1 - x) * (1 + x)), x);
}

double hypot(double x, double y) {
  x = std::abs(x), y = std::abs(y);
  if (x == kEndless || y == kEndless) return kEndless;
  if (std::isnan(x) || std::isnan(y)) return x + y;
  const double most = x > y ? x : y;
  const double scale = most > 0x1p500 ? 0x1p-600 : most < 0x1p-400 ? 0x1p600 : 1;
  x *= scale, y *= scale;
  return std::sqrt(x * x + y * y) / scale;
}

}  // namespace palpa::pinned
