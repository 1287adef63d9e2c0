#include "apps/bench/pictures/tracking_fit.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>

#include "anatomy/base/error.h"
#include "anatomy/base/random.h"
#include "anatomy/base/units.h"
#include "anatomy/geometry/dense_solvers.h"
#include "apps/twin/bench_truth.h"
#include "apps/twin/virtual_camera.h"

namespace palpa::bench {
namespace {

using ar::Matrix6;
using ar::Vector6;
using twin::TrackingFigures;
constexpr std::size_t kTerms = 1 + TrackingFigures::kWaves;  ///< what lasts, and the waves
using Terms = Eigen::Matrix<double, int(kTerms), 1>;

struct FitPicture {
  Vector6 z = Vector6::Zero();
  Eigen::Vector2d origin;  ///< of the pattern, px
  double misses = 0, freedom = 0;
  std::vector<TagChance> tags;
  bool good = false;  ///< enough tags for a pose
};

FitPicture taken(const twin::VirtualCamera& camera, const ar::Board& board,
                 const ar::TagGridSpec& spec, const Pose& X, std::uint64_t number) {
  const std::vector<ar::BoardPoint> points = board.detect(camera.render(X, number));
  FitPicture picture;
  picture.origin = camera.truth().project(X.translation());
  std::set<std::pair<double, double>> found;
  for (const ar::BoardPoint& point : points) found.emplace(point.p_W.x(), point.p_W.y());
  for (int i = 0; i < spec.columns * spec.rows; ++i) {
    const std::array<Vec3, 4> places = ar::tagCorners(spec, spec.first_id + i);
    std::array<Eigen::Vector2d, 4> pixels;
    for (std::size_t c = 0; c < 4; ++c) pixels[c] = camera.truth().project(X * places[c]);
    if (twin::isInPicture(pixels, camera.truth()))
      picture.tags.push_back(
          {twin::narrowest(pixels), found.count({places[0].x(), places[0].y()}) > 0});
  }
  constexpr std::size_t kEnough = 16;
  picture.good = points.size() >= kEnough;
  if (!picture.good) return picture;
  const ar::RefinedPose pose = ar::refinePose(X, points, camera.truth());
  picture.z = Eigen::LLT<Matrix6>(pose.information).matrixU() * ar::difference(pose.X_CW, X);
  picture.freedom = 2 * double(points.size()) - 6;
  picture.misses = pose.rms_px * pose.rms_px * double(points.size());
  return picture;
}

/// Pictures of one view; the last of them are the first once more.
using FitView = std::vector<FitPicture>;

/// As the camera sways there: from one moment on, close together and farther apart.
FitView viewOf(const twin::VirtualCamera& camera, const ar::Board& board,
               const ar::TagGridSpec& spec, const Pose& X, const TrackingFit& fit, double sway,
               RandomStream& random) {
  constexpr double kLongest = 100;  // s
  const double begin = kLongest * random.uniform();
  std::vector<Pose> poses;
  for (const double after : fit.seconds)
    poses.push_back(twin::swayed(X, sway, std::llround(1e9 * (begin + after))));
  FitView view;
  for (std::size_t i = 0; i < fit.seconds.size() + fit.repeated; ++i)
    view.push_back(taken(camera, board, spec, poses[i % poses.size()], random.bits() >> 40));
  return view;
}

/// Least squares with terms that are not negative: those that would be are left out.
Terms notNegative(const Eigen::Matrix<double, int(kTerms), int(kTerms)>& A, const Terms& b) {
  std::vector<Eigen::Index> in;
  for (Eigen::Index i = 0; i < A.rows(); ++i) in.push_back(i);
  while (!in.empty()) {
    const Eigen::Index n = Eigen::Index(in.size());
    Eigen::MatrixXd part(n, n);
    Eigen::VectorXd right(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      right[i] = b[in[std::size_t(i)]];
      for (Eigen::Index j = 0; j < n; ++j) part(i, j) = A(in[std::size_t(i)], in[std::size_t(j)]);
    }
    const Eigen::VectorXd x = solveSymmetric(part, right);
    Eigen::Index worst = 0;
    if (x.minCoeff(&worst) >= 0) {
      Terms all = Terms::Zero();
      for (Eigen::Index i = 0; i < n; ++i) all[in[std::size_t(i)]] = x[i];
      return all;
    }
    in.erase(in.begin() + worst);
  }
  return Terms::Zero();
}

/// How the products of two pictures' errors fall with what lies between them on the pixels.
Terms termsBetween(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  Terms terms;
  terms[0] = 1;
  for (std::size_t wave = 0; wave < TrackingFigures::kWaves; ++wave)
    terms[Eigen::Index(wave) + 1] = twin::PixelWave::correlation(wave, a - b);
  return terms;
}

Vector6 meanOf(const std::vector<FitView>& views) {
  Vector6 sum = Vector6::Zero();
  double good = 0;
  for (const FitView& view : views)
    for (const FitPicture& picture : view) {
      if (picture.good) sum += picture.z;
      good += picture.good;
    }
  return sum / std::max(good, 1.0);
}

/// Views from one place.
struct FitPlace {
  std::vector<FitView> views;
  Vector6 bias = Vector6::Zero();
  double strength = 1;
  double weight = 1;  ///< how often a camera stands there

  /// Without the bias. What chance of so few views is in that is not in the rest: the sum of both
  /// is what was measured.
  Vector6 left(const FitPicture& picture) const { return picture.z - bias; }
};

/// `of(place, view, picture)` for each good picture.
template <class Of>
void eachPicture(const std::vector<FitPlace>& places, const Of& of) {
  for (const FitPlace& place : places)
    for (const FitView& view : place.views)
      for (std::size_t i = 0; i < view.size(); ++i)
        if (view[i].good) of(place, view, i);
}

/// White is what two pictures of one pose have not in common.
Vector6 whiteOf(const std::vector<FitPlace>& places, std::size_t pictures) {
  Vector6 noise = Vector6::Zero();
  double repeated = 0;
  eachPicture(places, [&](const FitPlace&, const FitView& view, std::size_t i) {
    const std::size_t first = i - pictures;
    if (i < pictures || !view[first].good) return;
    noise += (view[i].z - view[first].z).cwiseAbs2() / 2;
    ++repeated;
  });
  return noise / std::max(repeated, 1.0);
}

/// How much stronger what is not white is from each place, against all of them; neighbours share.
void fitStrength(const Vector6& white, std::vector<FitPlace>* places) {
  const auto variance = [&](const std::vector<FitPlace>& of) {
    Vector6 sum = Vector6::Zero();
    double n = 0;
    eachPicture(of, [&](const FitPlace& place, const FitView& view, std::size_t i) {
      sum += place.left(view[i]).cwiseAbs2();
      ++n;
    });
    // Where all is white, the strength of the rest means nothing.
    const Vector6 least = 0.01 * white + Vector6::Constant(1e-9);
    return Vector6((sum / std::max(n, 1.0) - white).cwiseMax(least));
  };
  const Vector6 all = variance(*places);
  std::vector<double> ratio;
  for (const FitPlace& place : *places)
    ratio.push_back(variance({place}).cwiseQuotient(all).mean());
  for (std::size_t j = 0; j < ratio.size(); ++j) {
    const double before = ratio[j > 0 ? j - 1 : j],
                 after = ratio[std::min(j + 1, ratio.size() - 1)];
    (*places)[j].strength = std::sqrt((before + 2 * ratio[j] + after) / 4);
  }
}

/// What is not white, by its parts: least squares over all pairs of pictures of one view, and so
/// that the parts add up (an equation with the weight of all pairs).
void fitSpread(const std::vector<FitPlace>& places, const Vector6& white,
               TrackingFigures::Distance* out) {
  Eigen::Matrix<double, int(kTerms), int(kTerms)> A = decltype(A)::Zero();
  Eigen::Matrix<double, int(kTerms), 6> b = decltype(b)::Zero();
  Vector6 squares = Vector6::Zero();
  double pictures = 0, pairs = 0, misses = 0, freedom = 0;  // the first two: weights
  eachPicture(places, [&](const FitPlace& place, const FitView& view, std::size_t i) {
    const double by = place.weight / (place.strength * place.strength);
    squares += by * (place.left(view[i]).cwiseAbs2() - white);
    pictures += place.weight;
    misses += place.weight * view[i].misses;
    freedom += place.weight * view[i].freedom;
    for (std::size_t j = 0; j < i; ++j) {
      if (!view[j].good) continue;
      const Terms terms = termsBetween(view[i].origin, view[j].origin);
      A += place.weight * terms * terms.transpose();
      b += by * terms * place.left(view[i]).cwiseProduct(place.left(view[j])).transpose();
      pairs += place.weight;
    }
  });
  out->corner_sigma = std::sqrt(misses / freedom);
  out->white = white.cwiseSqrt();
  A += pairs * Terms::Ones() * Terms::Ones().transpose();
  b += pairs * Terms::Ones() * (squares / pictures).cwiseMax(0).transpose();
  for (int k = 0; k < 6; ++k) {
    const Terms part = notNegative(A, b.col(k));
    out->lasting[k] = std::sqrt(part[0]);
    for (std::size_t h = 0; h < TrackingFigures::kWaves; ++h)
      out->wander[h][k] = std::sqrt(part[int(h) + 1]);
  }
}

std::vector<TagChance> tagsOf(const FitPlace& place) {
  std::vector<TagChance> tags;
  for (const FitView& view : place.views)
    for (const FitPicture& picture : view)
      tags.insert(tags.end(), picture.tags.begin(), picture.tags.end());
  return tags;
}

/// Those that were seen twice from one pose.
std::vector<std::array<TagChance, 2>> repeatedTags(const std::vector<FitPlace>& places,
                                                   std::size_t pictures) {
  std::vector<std::array<TagChance, 2>> tags;
  for (const FitPlace& place : places)
    for (const FitView& view : place.views)
      for (std::size_t i = pictures; i < view.size(); ++i)
        for (std::size_t t = 0; t < view[i].tags.size(); ++t)
          tags.push_back({view[i - pictures].tags[t], view[i].tags[t]});
  return tags;
}

TrackingFigures startOf(const station::Station& station, const TrackingFit& fit) {
  TrackingFigures f;
  f.width = station.design.camera.width;
  f.height = station.design.camera.height;
  f.fx = station.design.camera.fx;
  f.decimate = station.decimate;
  f.board = station.board;
  const int steps = int(std::lround(fit.most_aside / fit.aside_step));
  for (int i = -steps; i <= steps; ++i) f.aside.push_back(i * fit.aside_step);
  return f;
}

/// What a fit looks with.
struct FitRig {
  const station::Station& station;
  const TrackingFit& fit;
  std::unique_ptr<ar::Board> board;
  double sway;

  FitRig(const station::Station& at, const TrackingFit& of)
      : station(at),
        fit(of),
        board(ar::makeBoard(at.board, at.decimate)),
        sway(twin::boomSway(at)) {}

  /// `number`: of the place. No two views are through the same lens: what one lens does would be
  /// taken for what the place does.
  FitPlace place(std::size_t number, double distance, double aside, RandomStream& random) const {
    const double across = aside / std::sqrt(1 - aside * aside);  // as the boom is told
    FitPlace place;
    for (int i = 0; i < fit.views; ++i) {
      const std::uint64_t seed = fit.seed + number * std::uint64_t(fit.views) + std::uint64_t(i);
      const twin::VirtualCamera camera(twin::trueCamera(station, seed), station.board,
                                       twin::VirtualCameraSettings{}, seed);
      const Pose X = twin::boomView(distance * random.uniform(0.99, 1.01), across);
      place.views.push_back(viewOf(camera, *board, station.board, X, fit, sway, random));
    }
    place.bias = meanOf(place.views);
    place.weight = std::max(std::exp(-0.5 * std::pow(aside / twin::kBoomAside, 2)), 0.05);
    return place;
  }
};

void requireSeen(const std::vector<FitPlace>& places, double distance) {
  double good = 0;
  eachPicture(places, [&](const FitPlace&, const FitView&, std::size_t) { ++good; });
  if (good > 0) return;
  throw Error("shows no board whose place could be told from " +
                  std::to_string(std::lround(distance / kMm)) + " mm",
              "the virtual camera", "Give a --station whose camera sees its board from there");
}

/// All but the widths.
TrackingFigures::Distance figuresOf(std::vector<FitPlace>* places, double distance,
                                    std::size_t pictures) {
  requireSeen(*places, distance);
  const Vector6 white = whiteOf(*places, pictures);
  fitStrength(white, places);
  TrackingFigures::Distance out;
  out.distance = distance;
  fitSpread(*places, white, &out);
  for (const FitPlace& place : *places) {
    out.bias.push_back(place.bias);
    out.strength.push_back(place.strength);
  }
  return out;
}

/// From which width on tags are found: at each place, and how sharply everywhere.
void fitWidths(const std::vector<FitPlace>& all, std::size_t pictures, TrackingFigures* figures) {
  std::vector<TagChance> every;
  for (const FitPlace& place : all) {
    const std::vector<TagChance> tags = tagsOf(place);
    every.insert(every.end(), tags.begin(), tags.end());
  }
  const TagWidths widths = fitTagWidths(every);
  figures->width_spread = widths.spread;
  figures->width_lasting = lastingShareOf(repeatedTags(all, pictures), widths);
  for (std::size_t i = 0; i < all.size(); ++i)
    figures->distances[i / figures->aside.size()].least_width.push_back(
        leastWidthOf(tagsOf(all[i]), widths.spread, widths.least));
}

}  // namespace

TrackingFigures fitTracking(const station::Station& station, const TrackingFit& fit,
                            const ShareDone& done) {
  TrackingFigures figures = startOf(station, fit);
  const FitRig rig(station, fit);
  RandomStream random(fit.seed, "bench.tracking_fit");
  std::vector<FitPlace> all;
  for (const double distance : fit.distances) {
    std::vector<FitPlace> places;
    for (const double aside : figures.aside) {
      places.push_back(rig.place(all.size() + places.size(), distance, aside, random));
      if (done)
        done(double(all.size() + places.size()) /
             double(fit.distances.size() * figures.aside.size()));
    }
    figures.distances.push_back(figuresOf(&places, distance, fit.seconds.size()));
    for (FitPlace& place : places) all.push_back(std::move(place));
  }
  fitWidths(all, fit.seconds.size(), &figures);
  return figures;
}

}  // namespace palpa::bench
