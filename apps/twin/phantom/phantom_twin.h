#pragma once

#include <array>

#include "apps/twin/phantom/pair_table.h"
#include "apps/twin/phantom/silicone_contact.h"

namespace palpa::twin {

/// A simulated phantom under a moving tool: elasticity from finite elements, what else silicone
/// does on top. Frame P of SoftBlock.
class PhantomTwin {
 public:
  PhantomTwin(PhantomTable table, const SiliconeLaw& law)
      : table_(std::move(table)), contact_(law) {}
  /// The tool's lowest point is at `tip` after another `dt`.
  PhantomTouch step(const Vec3& tip, double dt);

 private:
  PhantomTable table_;
  SiliconeContact contact_;
};

/// The same under two tools side by side along x, the first `PairTable::apart` beyond the second,
/// in the plane y = 0.
class PhantomPairTwin {
 public:
  PhantomPairTwin(PhantomTable one, PairTable both, const SiliconeLaw& law)
      : one_(std::move(one)),
        both_(std::move(both)),
        contacts_{SiliconeContact(law), SiliconeContact(law)} {}
  /// Throws Error where the tools do not stand like this.
  std::array<PhantomTouch, 2> step(const std::array<Vec3, 2>& tips, double dt);

 private:
  PhantomTable one_;
  PairTable both_;
  std::array<SiliconeContact, 2> contacts_;
};

}  // namespace palpa::twin
