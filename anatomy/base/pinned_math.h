#pragma once

namespace palpa::pinned {

/// Transcendental functions that give the same bits on every computer. The C library chooses
/// between several versions of its own by the processor (with and without fused multiply-add), and
/// they differ in the last bit; these use additions, multiplications, divisions and square roots
/// only, in one order. What is computed again from a recording, and what judges, calls these
/// (tests/house/pinned_calls_test.cpp); sqrt, fmod, remainder, ldexp and rounding are exact in any
/// library.
///
/// Arguments in radians where they are angles. The largest error, in units of the last place
/// (tests/base/pinned_math_test.cpp measures it): 0.6 for exp, log and pow, 0.9 for sin and cos, 1
/// for expm1, 1.5 for log1p, atan, atan2 and hypot, 2.5 for tan, asin, acos and tanh, 30 for erfc;
/// one more where the result is below the normal numbers. Infinities, NaN, zeros and numbers
/// outside of the domain: as the C library's, without errno.
double exp(double x);
double expm1(double x);  ///< exp(x) - 1
double log(double x);    ///< natural
double log1p(double x);  ///< log(1 + x)
double pow(double x, double y);
double tanh(double x);
double erfc(double x);
double sin(double x);
double cos(double x);
double tan(double x);
double asin(double x);
double acos(double x);
double atan(double x);
double atan2(double y, double x);
double hypot(double x, double y);

}  // namespace palpa::pinned
