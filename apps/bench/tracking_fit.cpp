#include "apps/bench/tracking_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <tuple>

#include "anatomy/base/random.h"
#include "anatomy/base/whole_file.h"
#include "apps/bench/timing.h"
#include "apps/bench/tracking_scene.h"
#include "apps/station/assets.h"
#include "apps/twin/bench_truth.h"
#include "apps/twin/virtual_camera.h"

namespace palpa::bench {
namespace {

using ar::Matrix6;
using ar::Vector6;
using twin::TrackingFigures;
constexpr std::size_t kTerms = 1 + TrackingFigures::kWaves;  ///< what lasts, and the waves
using Terms = Eigen::Matrix<double, int(kTerms), 1>;

/// Whether a tag of this width was found.
struct TagChance {
  double width = 0;
  bool found = false;
};

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

/// As the camera sways there.
FitView viewOf(const twin::VirtualCamera& camera, const ar::Board& board,
               const ar::TagGridSpec& spec, const Pose& X, const TrackingFit& fit, double sway,
               RandomStream& random) {
  constexpr double kLongest_ns = 100e9;
  std::vector<Pose> poses;
  for (int i = 0; i < fit.pictures; ++i)
    poses.push_back(twin::swayed(X, sway, std::llround(kLongest_ns * random.uniform())));
  FitView view;
  for (int i = 0; i < fit.pictures + fit.repeated; ++i)
    view.push_back(taken(camera, board, spec, poses[std::size_t(i % fit.pictures)],
                         std::uint64_t(random.bits() >> 40)));
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
    const Eigen::VectorXd x = part.ldlt().solve(right);
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
  for (int h = 1; h < int(kTerms); ++h) {
    const Eigen::Vector2d turn = twin::PixelWave::turnsOf(h) * (a - b);
    terms[h] = 0.5 * (std::cos(turn.x()) + std::cos(turn.y()));
  }
  return terms;
}

/// What is left of the errors besides the bias, of all pictures.
struct Spread {
  Eigen::Matrix<double, int(kTerms), int(kTerms)> A = decltype(A)::Zero();
  Eigen::Matrix<double, int(kTerms), 6> b = decltype(b)::Zero();
  Vector6 squares = Vector6::Zero(), noise = Vector6::Zero();
  double pictures = 0, pairs = 0, repeated = 0, misses = 0, freedom = 0;

  void add(const FitView& view, const Vector6& bias, int pictures_in_view) {
    for (std::size_t i = 0; i < view.size(); ++i) {
      if (!view[i].good) continue;
      squares += (view[i].z - bias).cwiseAbs2();
      ++pictures;
      misses += view[i].misses;
      freedom += view[i].freedom;
      for (std::size_t j = 0; j < i; ++j)
        if (view[j].good) addPair(view[j], view[i], bias, i - j == std::size_t(pictures_in_view));
    }
  }
  void addPair(const FitPicture& one, const FitPicture& other, const Vector6& bias, bool same) {
    if (same) {
      noise += (one.z - other.z).cwiseAbs2() / 2;
      ++repeated;
      return;
    }
    const Terms terms = termsBetween(one.origin, other.origin);
    A += terms * terms.transpose();
    b += terms * (one.z - bias).cwiseProduct(other.z - bias).transpose();
    ++pairs;
  }
};

/// By its parts. White is what two pictures of one pose have not in common; the rest is divided so
/// that it adds up (an equation with the weight of all pairs).
void fitSpread(const Spread& s, TrackingFigures::Distance* out) {
  out->corner_sigma = std::sqrt(s.misses / s.freedom);
  for (int k = 0; k < 6; ++k) {
    const double white = s.noise[k] / std::max(s.repeated, 1.0),
                 lasting = std::max(s.squares[k] / s.pictures - white, 0.0);
    const Terms part =
        notNegative(s.A + s.pairs * Terms::Ones() * Terms::Ones().transpose(),
                    s.b.col(k) + s.pairs * lasting * Terms::Ones());
    out->lasting[k] = std::sqrt(part[0]);
    for (std::size_t h = 0; h < TrackingFigures::kWaves; ++h)
      out->wander[h][k] = std::sqrt(part[int(h) + 1]);
    out->white[k] = std::sqrt(white);
  }
}

double normalShare(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

/// Where tags cease to be found, from all distances: the largest likelihood of a normal threshold, by Fisher's scoring.
void fitWidths(const std::vector<TagChance>& tags, TrackingFigures* out) {
  constexpr double kSurelyFound = 25;  // px
  double a = -15 / 1.5, b = 1 / 1.5;   // found: a + b width > a normal variate
  for (int iteration = 0; iteration < 30; ++iteration) {
    Eigen::Matrix2d information = 1e-9 * Eigen::Matrix2d::Identity();
    Eigen::Vector2d score = Eigen::Vector2d::Zero();
    for (const TagChance& tag : tags) {
      if (tag.width > kSurelyFound) continue;
      const double x = a + b * tag.width;
      const double share = std::clamp(normalShare(x), 1e-9, 1 - 1e-9),
                   density = std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi),
                   weight = density / (share * (1 - share));
      const Eigen::Vector2d by(1, tag.width);
      score += weight * ((tag.found ? 1 : 0) - share) * by;
      information += weight * density * by * by.transpose();
    }
    const Eigen::Vector2d step = information.ldlt().solve(score);
    a += step[0];
    b += step[1];
  }
  if (!(b > 1e-3)) return;  // every tag was found
  out->width_spread = 1 / b;
  for (TrackingFigures::Distance& distance : out->distances) distance.least_width = -a / b;
}

/// So that at one distance as many are found as there were: the normal threshold is an
/// approximation.
void fitLeastWidth(const std::vector<TagChance>& tags, double spread,
                   TrackingFigures::Distance* out) {
  double found = 0;
  for (const TagChance& tag : tags) found += tag.found;
  if (found == 0 || found == double(tags.size())) return;
  double low = 0, high = 100;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    double expected = 0;
    for (const TagChance& tag : tags) expected += normalShare((tag.width - middle) / spread);
    (expected > found ? low : high) = middle;
  }
  out->least_width = low;
}

/// Two pictures of the same pose disagree so often about a tag at x where this share of the
/// variance is common to them.
double disagreementAt(double x, double lasting) {
  double sum = 0, weights = 0;
  for (double phi = -4; phi <= 4; phi += 0.25) {
    const double weight = std::exp(-phi * phi / 2),
                 share = normalShare((x - std::sqrt(lasting) * phi) / std::sqrt(1 - lasting));
    sum += weight * 2 * share * (1 - share);
    weights += weight;
  }
  return sum / weights;
}

void fitLasting(const std::vector<FitView>& views, int pictures, double least_width,
                TrackingFigures* out) {
  std::vector<double> at;
  double differ = 0;
  for (const FitView& view : views)
    for (std::size_t i = std::size_t(pictures); i < view.size(); ++i)
      for (std::size_t t = 0; t < view[i].tags.size(); ++t) {
        const TagChance &first = view[i - std::size_t(pictures)].tags[t], &again = view[i].tags[t];
        const double x = (first.width - least_width) / out->width_spread;
        if (std::abs(x) > 3) continue;
        at.push_back(x);
        differ += first.found != again.found;
      }
  double low = 0, high = 0.99;
  for (int i = 0; i < 12 && !at.empty(); ++i) {
    const double middle = (low + high) / 2;
    double expected = 0;
    for (const double x : at) expected += disagreementAt(x, middle);
    (expected > differ ? low : high) = middle;
  }
  out->width_lasting = at.empty() ? 0 : low;
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

}  // namespace

TrackingFigures fitTracking(const station::Station& station, const TrackingFit& fit,
                            const ShareDone& done) {
  TrackingFigures figures = startOf(station, fit);
  const auto board = ar::makeBoard(station.board, station.decimate);
  std::vector<twin::VirtualCamera> cameras;
  for (int i = 0; i < fit.views; ++i) {
    const std::uint64_t seed = fit.seed + std::uint64_t(i);
    cameras.emplace_back(twin::trueCamera(station, seed), station.board,
                         twin::VirtualCameraSettings{}, seed);
  }
  RandomStream random(fit.seed, "bench.tracking_fit");
  const double sway = twin::boomSway(station);
  std::vector<FitView> all;
  std::vector<std::vector<TagChance>> tags(fit.distances.size());
  for (std::size_t d = 0; d < fit.distances.size(); ++d) {
    Spread spread;
    TrackingFigures::Distance& out = figures.distances.emplace_back();
    out.distance = fit.distances[d];
    for (const double aside : figures.aside) {
      const double across = aside / std::sqrt(1 - aside * aside);  // as the boom is told
      std::vector<FitView> views;
      for (const twin::VirtualCamera& camera : cameras) {
        const Pose X = twin::boomView(out.distance * random.uniform(0.99, 1.01), across);
        views.push_back(viewOf(camera, *board, station.board, X, fit, sway, random));
      }
      out.bias.push_back(meanOf(views));
      for (FitView& view : views) {
        spread.add(view, out.bias.back(), fit.pictures);
        for (const FitPicture& picture : view)
          tags[d].insert(tags[d].end(), picture.tags.begin(), picture.tags.end());
        all.push_back(std::move(view));
      }
      if (done)
        done((double(d) + double(out.bias.size()) / double(figures.aside.size())) /
             double(fit.distances.size()));
    }
    fitSpread(spread, &out);
  }
  std::vector<TagChance> every;
  for (const std::vector<TagChance>& some : tags) every.insert(every.end(), some.begin(), some.end());
  fitWidths(every, &figures);
  fitLasting(all, fit.pictures, figures.distances.front().least_width, &figures);
  for (std::size_t d = 0; d < tags.size(); ++d)
    fitLeastWidth(tags[d], figures.width_spread, &figures.distances[d]);
  return figures;
}

namespace {

void printFigures(const TrackingFigures& figures, const std::string& station) {
  const nlohmann::json all = twin::jsonOf(figures);
  for (const nlohmann::json& distance : all.at("distances")) {
    nlohmann::json params = distance;
    params.erase("corner_sigma_px");
    params["data"] = "simulated";
    print("tracking_model.corner_sigma", distance.at("corner_sigma_px"), "px", params);
  }
  nlohmann::json params = all.at("found");
  params.erase("width_spread_px");
  params.update({{"data", "simulated"}, {"station", station}});
  print("tracking_model.width_spread", figures.width_spread, "px", params);
}

TrackingFit quickFit() {
  TrackingFit fit;
  fit.distances = {0.45, 1.0};
  fit.most_aside = fit.aside_step = 0.12;
  fit.views = 2;
  fit.pictures = 3;
  fit.repeated = 1;
  return fit;
}

}  // namespace

void fitTrackingModel(const TrackingFitOptions& options) {
  const station::Station station = station::readStation(
      options.station.empty() ? station::assetFile("stations/virtual_bench.json")
                              : std::filesystem::path(options.station));
  const TrackingFigures figures =
      fitTracking(station, options.quick ? quickFit() : TrackingFit{}, options.done);
  printFigures(figures, station.title);
  nlohmann::json file = twin::jsonOf(figures);
  file["about"] = "Errors of poses from simulated pictures, for sessions with --tracking model.";
  file["source"] = "palpa bench tracking --fit, on pictures of the virtual camera (" +
                   station.title + "), lenses of the seeds from " +
                   std::to_string(TrackingFit{}.seed) + " on";
  WholeFile written(options.file);
  written.write(file.dump(1) + "\n");
  written.finish();
}

namespace {

double ratioOf(double model, double pictures) { return pictures > 0 ? model / pictures : 1; }

void printComparison(const PathFigures& pictures, const PathFigures& model,
                     const nlohmann::json& params) {
  const std::tuple<const char*, double PathFigures::*, const char*> all[]{
      {"shift_rms", &PathFigures::shift_mm, "mm"},
      {"turn_rms", &PathFigures::turn_mrad, "mrad"},
      {"filtered_shift_rms", &PathFigures::filtered_shift_mm, "mm"},
      {"filtered_turn_rms", &PathFigures::filtered_turn_mrad, "mrad"},
      {"tags_missed", &PathFigures::tags_missed, "1"},
      {"poses_missed", &PathFigures::poses_missed, "1"}};
  for (const auto& [name, figure, unit] : all) {
    nlohmann::json both = params;
    both.update({{"model", model.*figure}, {"pictures", pictures.*figure}, {"of", unit}});
    print(std::string("tracking_model.") + name, ratioOf(model.*figure, pictures.*figure), "1",
          both);
  }
  for (std::size_t l = 0; l < kTrackingLags.size(); ++l) {
    nlohmann::json both = params;
    both.update({{"model", model.autocorrelation[l]},
                 {"pictures", pictures.autocorrelation[l]},
                 {"lag_pictures", kTrackingLags[l]}});
    print("tracking_model.autocorrelation_difference",
          model.autocorrelation[l] - pictures.autocorrelation[l], "1", both);
  }
}

}  // namespace

void benchTrackingModel(const TrackingModelOptions& options) {
  const station::Station station = station::readStation(
      options.station.empty() ? station::assetFile("stations/virtual_bench.json")
                              : std::filesystem::path(options.station));
  const TrackingFigures figures = twin::trackingFiguresOf(station);
  std::vector<TrackedSession> pictures, model;
  for (int i = 0; i < options.sessions; ++i) {
    const std::uint64_t seed = options.seed + std::uint64_t(i);
    pictures.push_back(
        trackedSession(station, seed, options.pictures, TrackedBy::pictures, figures));
    model.push_back(trackedSession(station, seed, options.pictures, TrackedBy::model, figures));
    if (options.done) options.done((i + 1.0) / options.sessions);
  }
  printComparison(figuresOf(pictures), figuresOf(model),
                  {{"sessions", options.sessions},
                   {"pictures_each", options.pictures},
                   {"seed", options.seed},
                   {"data", "simulated"}});
}

}  // namespace palpa::bench
