#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "anatomy/base/random.h"
#include "anatomy/geometry/top_shape.h"
#include "apps/twin/hand.h"
#include "apps/twin/operator_skills.h"
#include "apps/twin/touch_memory.h"

namespace palpa::twin {

/// What anybody sees of the phantom: where it lies on the screen, its shape, and the area that is
/// to be searched. P: origin in the middle of the top, z up. Places lie along the top.
struct VisiblePhantom {
  Pose X_AP = Pose::Identity();
  double half_x = 0, half_y = 0;  ///< m
  std::function<double(const Vec3& p_P)>
      /// M, to where something firm belongs in such a body: what books teach, not what this case
      /// holds; empty: nowhere
      from_normal;
  TopShape top = {};
  /// The place of the area that is nearest, itself where it lies in it; empty: the rectangle is
  /// the area
  std::function<Vec3(const Vec3& p_P)> to_area = {};
  /// How much longer ways along the top are than they look from above, where it is steepest
  Eigen::Vector2d longer = Eigen::Vector2d(1, 1);
};

/// What a simulated person makes of the presses of a search for lumps, and so where to press next:
/// in vertical strips; closer where it gave way less than the nearest ordinary places; a mark where
/// that stays so. Knows how far it gave way, and its own mistakes of judging that; moves nothing.
/// Frame P of the phantom, m.
class LumpSearch {
 public:
  enum class Deed { press, mark, end };
  struct Intent {
    Deed deed = Deed::end;
    Vec3 p_P = Vec3::Zero();
    Hand::Word word;    ///< of a mark its grade, at the end that it is done
    bool both = false;  ///< a press: of a second finger, too, `apart` beside
  };
  /// `fingers`: one, or two that search side by side, so many strips apart as fingers are.
  LumpSearch(const PalpatingSkill& skill, const VisiblePhantom& phantom, int fingers,
             std::uint64_t seed);

  void begin(int trial);
  /// Of a press: how far it gave way to the first pressure, and from there to each of the others.
  /// Of two fingers first the one, then the other.
  void felt(const Vec3& p_P, std::vector<double> depths);
  Intent next();
  bool looksCloser() const { return suspect_P_.has_value(); }
  const Vec3& apart() const { return apart_; }  ///< from the first finger to the second

 private:
  enum class Look {
    again,
    climb,
    confirm
  };  ///< of a closer look: was it chance, where is it firmest, is it a lump
  void planStrips();
  bool takeIn(Vec3* planned) const;
  bool lookCloser();
  void beginLook(const Vec3& top_P, const FeltPress& felt);
  bool lookBack();
  Vec3 thoughtOver(Vec3 p_P) const;
  void planCross(const Vec3& p_P);
  Vec3 inArea(const Vec3& p_P) const;
  Intent decide();
  bool goesAside(const Vec3& from_P, double firmest);
  Intent dismiss();
  void pressAfresh(const Vec3& p_P, int times, Look look);
  bool accountedFor(const Vec3& p_P) const;
  bool known(const Vec3& p_P) const;
  double fromNormal(const Vec3& p_P) const;
  Hand::Word grade(const Vec3& p_P, double firmest);

  PalpatingSkill skill_;
  VisiblePhantom phantom_;
  std::uint64_t seed_;
  int fingers_, strips_, beside_ = 1;  ///< of the area; of them, between two fingers
  Vec3 apart_ = Vec3::Zero();
  RandomStream judgement_;
  /// Still to be pressed, the next one last: in the search, in the closer look that is on
  std::vector<Vec3> places_, closer_places_;
  TouchMemory memory_;
  std::vector<FeltPress> closer_, fresh_;
  std::vector<FeltPress> waiting_;  ///< of the search, still to be thought about
  std::optional<Vec3> suspect_P_;   ///< a closer look is on
  int rounds_left_ = 0;
  bool aside_ = false;  ///< went on from a flank in this look
  Look look_ = Look::climb;
  std::vector<Vec3> marked_P_, dismissed_P_, looked_back_P_;
};

}  // namespace palpa::twin
