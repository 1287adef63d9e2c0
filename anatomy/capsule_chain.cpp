#include "anatomy/capsule_chain.h"

#include <algorithm>
#include <cmath>

namespace palpa::anatomy {
namespace {

constexpr double kFitReach = 0.020;   // of the bone around a point goes into a fit
constexpr double kFlattest = 0.020;   // a "tube" of larger radius is a plate: no capsule fits it
constexpr double kHalfLink = 0.008;
constexpr double kEndOfBone = 0.7;    // cosine: there the normal runs along the tube
constexpr double kRounded = 0.8;      // of its radius a bone's end lies beyond the end of its capsule

struct Link {
  Vec3 a, b;                          // ends on the axis
  double radius = 0;
  bool ends_a = false, ends_b = false;   // the bone ends there

  Vec3 along() const { return (b - a).normalized(); }
  Capsule capsule() const { return {pack(a), pack(b), radius, Organ::none, 0, {}}; }
};

/// The fitted tube cut to a link's length about `middle`, whose axis runs through `on_axis` along `axis`.
Link cut(const SurfaceQuery::Tube& tube, const Vec3& on_axis, const Vec3& axis, const Vec3& middle) {
  double low = (tube.a_A - on_axis).dot(axis), high = (tube.b_A - on_axis).dot(axis);
  if (low > high) std::swap(low, high);
  // A capsule reaches beyond its ends; the bone's vertices do not.
  const double shorten = std::min(kRounded * tube.radius, (high - low) / 2);
  low += shorten;
  high -= shorten;
  if (low > high) low = high = (low + high) / 2;  // by rounding
  const double centre = std::clamp((middle - on_axis).dot(axis), low, high);
  Link link;
  link.radius = tube.radius;
  link.ends_a = low > centre - kHalfLink;
  link.ends_b = high < centre + kHalfLink;
  link.a = on_axis + std::max(low, centre - kHalfLink) * axis;
  link.b = on_axis + std::min(high, centre + kHalfLink) * axis;
  return link;
}

bool fit(const SurfaceQuery& query, int surface, const Vec3& p, SurfaceQuery::Tube* tube) {
  return query.fitTube(surface, p, kFitReach, tube) && tube->radius <= kFlattest;
}

/// The middle link: moved so that it touches the surface at its nearest point with its normal.
Link touching(const SurfaceQuery::Tube& tube, const SurfacePoint& nearest) {
  const Vec3 fitted = (tube.b_A - tube.a_A).normalized();
  const double along = nearest.n_A.dot(fitted);
  if (std::abs(along) >= kEndOfBone) return cut(tube, tube.a_A, fitted, nearest.p_A);
  const Vec3 axis = (fitted - along * nearest.n_A).normalized();
  return cut(tube, nearest.p_A - tube.radius * nearest.n_A, axis, nearest.p_A);
}

/// The next link from the joint on: where the tube goes there. False where the bone ends.
bool next(const SurfaceQuery& query, int surface, const Vec3& joint, const Vec3& onward, Link* link) {
  const Vec3 ahead = joint + kHalfLink * onward;
  const SurfacePoint there = query.closest(surface, ahead);
  SurfaceQuery::Tube tube;
  if (there.distance > 0 || !fit(query, surface, there.p_A, &tube)) return false;
  Vec3 axis = (tube.b_A - tube.a_A).normalized();
  if (axis.dot(onward) < 0) axis = -axis;
  const Link piece = cut(tube, tube.a_A, axis, ahead);
  *link = piece;
  link->a = joint;
  return (piece.b - joint).dot(onward) > 0;
}

}  // namespace

std::vector<Capsule> capsuleChain(const SurfaceQuery& query, int surface, const SurfacePoint& nearest, int links) {
  SurfaceQuery::Tube tube;
  if (!fit(query, surface, nearest.p_A, &tube)) return {};
  const Link middle = touching(tube, nearest);
  std::vector<Capsule> chain{middle.capsule()};
  if (links < 3) return chain;
  Link side;
  if (!middle.ends_a && next(query, surface, middle.a, -middle.along(), &side)) chain.push_back(side.capsule());
  if (!middle.ends_b && next(query, surface, middle.b, middle.along(), &side)) chain.push_back(side.capsule());
  return chain;
}

}  // namespace palpa::anatomy
