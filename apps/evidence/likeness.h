#pragma once

#include <string>

namespace palpa::evidence {

/// How a record compares with what is computed again from it. Another processor's or an older
/// version's arithmetic moves last bits; who changes a record moves more.
enum class Likeness {
  same_bits,
  rounding,  ///< every number within kRounding, everything else equal
  changed
};

/// Of numbers: of their size, or absolute below 1.
inline constexpr double kRounding = 1e-9;

/// Not a number is like itself.
Likeness likeness(double recorded, double again);
/// Of two JSON texts: numbers as above, everything else equal or not. Throws Error for a text that
/// is no JSON.
Likeness likenessOfJson(const std::string& recorded, const std::string& again);

inline Likeness worse(Likeness a, Likeness b) { return a < b ? b : a; }

}  // namespace palpa::evidence
