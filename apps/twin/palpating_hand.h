#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "anatomy/base/random.h"
#include "anatomy/geometry/pose.h"
#include "apps/twin/hand.h"
#include "apps/twin/hand_motion.h"
#include "apps/twin/hand_senses.h"

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

/// How a simulated person palpates; fixed beforehand in assets/operators/palpation_*.json, each
/// figure with unit and source. SI units here.
struct PalpatingSkill {
  std::string name;
  HandGrip grip;
  double tremor_rms = 0, look_sd = 0;  ///< m
  double strip = 0, step = 0;          ///< m, between vertical strips, between presses along one
  double wander = 0;                   ///< m, how far from the planned place a press is
  double skip = 0;                     ///< share of places that are left out
  double area_share = 1;               ///< of the area, from the left, that is searched at all
  double travel_speed = 0, press_speed = 0;  ///< m/s
  /// N, rising, at each of which it is judged how far the surface gave way
  std::vector<double> pressures;
  double reaction = 0;                      ///< s
  double weber = 0;                         ///< standard deviation of ln of a judged depth
  double looks_closer = 0, marks_from = 0;  ///< ln of how much less it gives way than around
  int again = 0;  ///< presses of a place that seemed firm, before a closer look
  /// Of five presses about the place, at most, in a closer look that follows what is firmer;
  /// presses at the firmest place by which it is decided, 0: by those that led there
  int rounds = 0, confirms = 0;
  double closer_force = 1;  ///< how much harder a closer look presses
  double size_sd = 0;       ///< share
  double hard_from = 0;     ///< ln, as `marks_from`: from here on a lump is called hard
  /// What seemed firm waits until all about it has been felt; else a closer look begins at once
  bool feels_around = false;
  bool knows_anatomy = false;  ///< what belongs there is not taken for a lump
};
PalpatingSkill readPalpatingSkill(const std::filesystem::path& file);

/// What anybody sees of the phantom: where it lies on the screen, and the area that is to be
/// searched. P: origin in the middle of the top, z up.
struct VisiblePhantom {
  Pose X_AP = Pose::Identity();
  double half_x = 0, half_y = 0;  ///< m
  std::function<double(const Vec3& p_P)>
      /// M, to where something firm belongs in such a body: what books teach, not what this case
      /// holds; empty: nowhere
      from_normal;
};

/// A simulated person who searches a soft thing for lumps, in vertical strips: presses, judges how
/// far it gave way at each pressure against what the nearest ordinary places gave, looks closer
/// where it gave less, marks by holding still with the button, grades. Knows what is on the screen
/// and what the hand feels; nothing else.
class PalpatingHand final : public Hand {
 public:
  PalpatingHand(const PalpatingSkill& skill, const VisiblePhantom& phantom, const Pose& X_ET,
                std::uint64_t seed);

  Action act(const Senses& senses, double dt) override;
  const HandGrip& grip() const override { return skill_.grip; }

 private:
  enum class Look {
    again,
    climb,
    confirm
  };  ///< of a closer look: was it chance, where is it firmest, is it a lump
  enum class PalpationStep { rest, travel, press, overshoot, lift, mark, release };
  void think(const Senses& senses);
  void beginTrial(int trial, double now_s);
  void planStrips();
  void goTo(const Vec3& p_P, double now_s, PalpationStep next);
  void pressing(double now_s);
  void judge(double now_s);
  void next(double now_s);
  bool lookCloser();
  void beginLook(const Vec3& top_P, const FeltPress& felt);
  bool lookBack();
  Vec3 thoughtOver(Vec3 p_P) const;
  void planCross(const Vec3& p_P);
  Vec3 inArea(const Vec3& p_P) const;
  void decide(double now_s);
  bool goesAside(const Vec3& from_P, double firmest);
  void dismiss(double now_s);
  void pressAfresh(const Vec3& p_P, int times, Look look);
  bool accountedFor(const Vec3& p_P) const;
  bool known(const Vec3& p_P) const;
  double fromNormal(const Vec3& p_P) const;
  Word grade(const Vec3& p_P, double firmest);

  PalpatingSkill skill_;
  VisiblePhantom phantom_;
  Pose X_ET_, X_TE_;
  std::uint64_t seed_;
  RandomStream judgement_, noise_;
  Tremor tremor_;
  Bearings bearings_;
  double hand_speed_ = 0;
  Vec3 p_last_D_ = Vec3::Zero();
  std::int64_t next_thought_ns_ = 0, last_look_ns_ = 0;

  PalpationStep step_ = PalpationStep::rest, after_travel_ = PalpationStep::rest;
  int trial_ = 0;
  Vec3 tip_P_ = Vec3::Zero(), tip_now_P_ = Vec3::Zero();  ///< wanted, and where it is
  MinJerk move_;
  double since_s_ = 0;
  double felt_N_ = 0, air_N_ = 0, touched_z_ = 0, light_z_ = 0;
  double resistance_N_ = 0, z_ = 0;  ///< at the last thought
  bool touched_ = false;
  std::vector<double> depths_;  ///< of this press so far
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
  Word word_;
  bool done_ = false;
};

}  // namespace palpa::twin
