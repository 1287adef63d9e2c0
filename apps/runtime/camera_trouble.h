#pragma once

#include <string>
#include <vector>

#include "apps/runtime/bus.h"

namespace palpa::runtime {

/// What is wrong with the camera or with what it sees, in words for whoever stands beside it;
/// empty: nothing. `view` null: no picture yet.
std::string cameraTrouble(const CameraView* view, std::int64_t now_ns);

/// Where a board belongs on the table; in the order of the camera's other boards.
struct BoardPlace {
  std::string name;
  std::optional<Pose> X_WB;  ///< empty: anywhere
  /// m that it may be off; the same at its edge, 0.1 m from its middle, for its turn
  double tolerance = 0.003;
};

struct Displaced {
  std::size_t board = 0;
  std::string words;
};

/// The first board that is seen elsewhere than it belongs. What is drawn and felt stays where it
/// was. `was`: the one that was told last: it counts as displaced until it is back within 0.7 of
/// its tolerance, so that one at the edge is told once.
std::optional<Displaced> displacedBoard(const CameraView& view,
                                        const std::vector<BoardPlace>& places,
                                        std::optional<std::size_t> was = std::nullopt);

}  // namespace palpa::runtime
