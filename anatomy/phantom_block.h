#pragma once

#include <string>

#include "anatomy/patient.h"

/// A block of silicone on a table, to be palpated from above, as a patient who lies on the back:
/// its top faces -y of A. Frame P of the block: the origin in the middle of its top, x to the right
/// and y away from who palpates, z up. x_A = x_P, y_A = -z_P, z_A = y_P. Metres.
namespace palpa::anatomy {

namespace landmark {
inline constexpr const char* kNearEdge =
    "near_edge";  ///< middle of the top's edge toward who palpates: from there it is looked at
}  // namespace landmark

inline constexpr double kBlockEdge = 0.004;  ///< m, radius of the edges

Pose X_AP();

/// `size`: along x, y, z of P. One closed skin and landmarks; for no needle. Throws Error for what
/// is no block: a side shorter than 10 mm or longer than 2 m.
Patient phantomBlock(const Vec3& size, const std::string& name);

}  // namespace palpa::anatomy
