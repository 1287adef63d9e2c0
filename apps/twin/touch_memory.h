#pragma once

#include <cstddef>
#include <vector>

#include "anatomy/geometry/pose.h"

namespace palpa::twin {

/// A press as a simulated examiner remembers it. Frame P of the phantom, m.
struct FeltPress {
  Vec3 p_P = Vec3::Zero();
  std::vector<double> depths;  ///< judged: how far it gave way to the first pressure, and from
                               ///< there to each of the others
  bool firm = false;           ///< it seemed to be when it was pressed
  double from_normal = 0;  ///< m to what belongs there and is felt, as far as one knows of it; the
                           ///< same everywhere: one knows of none
};

double across(const Vec3& a, const Vec3& b);  ///< m, along the top

/// What the presses of a search have told so far, and how firm a place is beside the others: ln of
/// how much less it gives way, 0 where it is like them.
class TouchMemory {
 public:
  /// With several pressures the first one only says where the surface is: when it was touched is
  /// told badly.
  explicit TouchMemory(std::size_t pressures) : first_told_(pressures > 1 ? 1 : 0) {}

  void forget() { presses_.clear(); }
  void add(const FeltPress& press) { presses_.push_back(press); }
  const std::vector<FeltPress>& presses() const { return presses_; }

  /// Against the nearest places that seemed ordinary and lie about as far from what belongs there,
  /// mean over the pressures; 0 while there are too few of them.
  double firmness(const FeltPress& press) const;
  double meanFirmness(const std::vector<FeltPress>& presses) const;
  /// Where the top of a firm hill lies that was felt about `centre`: the place, to a millimetre,
  /// from which a round hill as wide as a fingertip feels a lump explains best what `presses` and
  /// the search itself told there. `centre` where there is no hill.
  Vec3 hillTop(const std::vector<FeltPress>& presses, const Vec3& centre) const;
  /// Root mean square distance of what is firm about `centre`, over everything remembered and
  /// `more`.
  double spreadAbout(const Vec3& centre, const std::vector<FeltPress>& more) const;

 private:
  std::vector<double> ordinaryAbout(const FeltPress& press, std::size_t pressure) const;
  std::size_t first_told_;
  std::vector<FeltPress> presses_;
};

}  // namespace palpa::twin
