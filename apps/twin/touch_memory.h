#pragma once

#include <cstddef>
#include <vector>

#include "anatomy/geometry/pose.h"

namespace palpa::twin {

/// A press as a simulated examiner remembers it. Frame P of the phantom, m.
struct FeltPress {
  Vec3 p_P = Vec3::Zero();
  /// Judged: how far it gave way to the first pressure, and from there to each of the others
  std::vector<double> depths;
  bool firm = false;  ///< it seemed to be when it was pressed
  /// M to what belongs there and is felt, as far as one knows of it; the same everywhere: one knows
  /// of none
  double from_normal = 0;
  bool looked = false;  ///< the hill that it is on was looked at
};

double across(const Vec3& a, const Vec3& b);  ///< m, along the top

/// What the presses of a search have told so far, and how firm a place is beside the others: ln of
/// how much less it gives way, 0 where it is like them.
class TouchMemory {
 public:
  /// With several pressures the first one only says where the surface is: when it was touched is
  /// told badly.
  explicit TouchMemory(std::size_t pressures) : first_reported_(pressures > 1 ? 1 : 0) {}

  void forget() { presses_.clear(); }
  void add(const FeltPress& press) { presses_.push_back(press); }
  const std::vector<FeltPress>& presses() const { return presses_; }

  /// Against the nearest places that seemed ordinary and lie about as far from what belongs there;
  /// of the pressures the deeper ones, at which more gives way, count more. 0 while there are too
  /// few such places.
  double firmness(const FeltPress& press) const;
  double meanFirmness(const std::vector<FeltPress>& presses) const;
  /// Of a firm hill that was felt about a place.
  struct Hill {
    Vec3 top;
    double explained;  ///< sum of squares of firmness; 0: there is none
  };
  /// Its top is the place, to a millimetre, from which a round hill as wide as a fingertip feels a
  /// lump explains best what `presses` and the search itself told there. `centre` where there is no
  /// hill.
  Hill hillAbout(const std::vector<FeltPress>& presses, const Vec3& centre) const;
  /// The firmest press of all within `reach` of `centre`; none where nothing was pressed there.
  const FeltPress* firmestAbout(const Vec3& centre, double reach) const;
  /// Root mean square distance of what is firm about `centre`, over everything remembered and
  /// `more`.
  double spreadAbout(const Vec3& centre, const std::vector<FeltPress>& more) const;

 private:
  std::vector<double> ordinaryAbout(const FeltPress& press, std::size_t pressure) const;
  std::size_t first_reported_;
  std::vector<FeltPress> presses_;
};

}  // namespace palpa::twin
