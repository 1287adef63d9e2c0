#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

/// What a soft thing is like all over its surface, learnt from touches here and there.
namespace palpa::calibration {

/// What one touch told of a figure that is above zero (stiffness, friction): its natural logarithm
/// and the standard deviation of that.
struct TouchedPlace {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< m, along the surface
  double ln = 0, sd = 0;
};

struct MapValue {
  double value = 0, low = 0, high = 0;  ///< the middle and the ends of the 95 % interval
  double sd = 0;                        ///< of the logarithm
};

/// A figure all over a surface, by a Gaussian process on its logarithm:
///     ln v(p) = c + g(p),   cov(g(p), g(q)) = s^2 M(|p - q| / l),   touch = ln v + e
///     M(r) = (1 + sqrt(5) r + 5 r^2 / 3) exp(-sqrt(5) r) or exp(-r^2 / 2),   var e = sd^2 + tau^2
/// c is anything, with equal right. Spread s, reach l, the surplus noise tau and which M it is are
/// not chosen: all that the touches allow count, each as much as they make it probable, so that the
/// interval knows what is not known of them. Matern's M is twice smooth, as what a round tip feels
/// near an edge is; the other endlessly: without it, soft slopes were thought rougher than they
/// are, and an interval of 95 % held 99 %. (Rasmussen and Williams, Gaussian Processes for Machine
/// Learning, 2006: 2.2, 2.7, 4.2.1, 5.2.)
class ObjectMap {
 public:
  /// Throws Error for fewer than 6 touches, invalid figures, a spread of zero or less, and
  /// touches that are all in one place.
  /// `shared_sd`: of an error of the logarithm that all touches have in common, which no number of
  /// touches takes away.
  explicit ObjectMap(std::vector<TouchedPlace> touches, double shared_sd = 0);

  MapValue at(const Eigen::Vector2d& p) const;
  double reach() const { return reach_; }  ///< m: l, on average
  const std::vector<TouchedPlace>& touches() const { return touches_; }

 private:
  struct Process;  ///< M, s, l, tau; what follows from them
  static std::optional<Process> processOf(const std::vector<TouchedPlace>& touches,
                                          const Eigen::MatrixXd& likeness, double spread,
                                          double reach, double surplus);
  void learn(const Eigen::MatrixXd& apart);

  std::vector<TouchedPlace> touches_;
  double shared_sd_;
  std::vector<Process> processes_;
  double reach_ = 0;
};

struct ObjectMap::Process {
  double (*like)(double) = nullptr;  ///< M
  double weight = 0;                 ///< its logarithm at first
  double variance = 0, reach = 0, mean = 0, ones = 0;
  Eigen::MatrixXd lower;       ///< Cholesky's factor of the touches' covariance K
  Eigen::VectorXd pull, even;  ///< K^-1 (ln - c), K^-1 1
};

/// What of a surface is to be known.
struct MappedArea {
  Eigen::Vector2d low = Eigen::Vector2d::Zero(), high = Eigen::Vector2d::Zero();  ///< m
  double step = 3e-3;                ///< m, between the places that are looked at
  double within = 0.1, share = 0.9;  ///< of the value, known so well; on so much of the area
};
std::vector<Eigen::Vector2d> placesOf(const MappedArea& area);

struct MapVerdict {
  double known = 0;  ///< share of the area whose 95 % interval is within `within` on both sides
  bool sure = false;
  /// Where to touch next: the least known places, none within `apart` of another
  std::vector<Eigen::Vector2d> next;
};
MapVerdict judge(const ObjectMap& map, const MappedArea& area, int next = 1, double apart = 9e-3);

}  // namespace palpa::calibration
