#pragma once

#include <string>

/// Numbers as text, the same in every locale.
namespace palpa::report {

/// Shortest digits that read back to the same bits; for files.
std::string shortest(double value);

/// For people: `decimals` places, true minus sign, thin spaces between thousands (from 10 000 on),
/// "–" for what is no number. `fixed(-12345.67, 1)` is "−12 345.7".
std::string fixed(double value, int decimals);

/// As `fixed`, but trailing zeros after the point are left out: 7, 18.5, 0.25.
std::string trimmed(double value, int decimals);

/// For coordinates in SVG: at most one decimal, ASCII, never an exponent.
std::string coordinate(double value);

}  // namespace palpa::report
