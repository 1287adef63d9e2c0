#include "apps/twin/tracking_model.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/units.h"
#include "apps/station/assets.h"
#include "apps/twin/virtual_camera_picture.h"

namespace palpa::twin {

using ar::Matrix6;
using ar::Vector6;

namespace {

constexpr int kVersion = 1;
constexpr double kMostPx = 20;

std::vector<double> numbersIn(const JsonFile& file, const std::string& field, std::size_t count,
                              double least, double most) {
  std::vector<double> values = file.numbers(field);
  if (values.size() != count) file.refuse(field, "must be " + std::to_string(count) + " numbers");
  for (const double x : values)
    if (!(x >= least && x <= most))
      file.refuse(field, "must be " + std::to_string(std::lround(least)) + " to " +
                             std::to_string(std::lround(most)));
  return values;
}

Vector6 sixPixels(const JsonFile& file, const std::string& field) {
  return Vector6::Map(numbersIn(file, field, 6, -kMostPx, kMostPx).data());
}

/// `count` groups of six.
template <class Groups>
void readGroups(const JsonFile& file, const std::string& field, std::size_t count, Groups* groups) {
  const std::vector<double> values = numbersIn(file, field, 6 * count, -kMostPx, kMostPx);
  for (std::size_t i = 0; i < count; ++i) (*groups)[i] = Vector6::Map(values.data() + 6 * i);
}

TrackingFigures::Distance readDistance(const JsonFile& file, std::size_t places) {
  TrackingFigures::Distance one;
  one.distance = kMm * file.number("distance_mm", 100, 3000);
  one.corner_sigma = file.number("corner_sigma_px", 0, kMostPx);
  one.strength = numbersIn(file, "strength", places, 0, 100);
  one.least_width = numbersIn(file, "least_width_px", places, 0, 1000);
  one.bias.resize(places);
  readGroups(file, "bias_px", places, &one.bias);
  one.lasting = sixPixels(file, "lasting_px");
  one.white = sixPixels(file, "white_px");
  readGroups(file, "wander_px", TrackingFigures::kWaves, &one.wander);
  return one;
}

template <class Of>
void requireRising(const JsonFile& file, const std::string& field, std::size_t n, Of of) {
  if (n < 2) file.refuse(field, "must have two entries or more");
  for (std::size_t i = 1; i < n; ++i)
    if (!(of(i) > of(i - 1))) file.refuse(field, "must rise from entry to entry");
}

}  // namespace

TrackingFigures readTrackingFigures(const std::filesystem::path& path) {
  return trackingFiguresIn(JsonFile(path));
}

TrackingFigures trackingFiguresIn(const JsonFile& file) {
  needKind(file, "tracking_model", kVersion);
  TrackingFigures f;
  f.width = file.integer("camera/width_px", 16, 20000);
  f.height = file.integer("camera/height_px", 16, 20000);
  f.fx = file.number("camera/fx_px", 10, 1e6);
  f.decimate = file.number("camera/decimate", 1, 8);
  f.board.columns = file.integer("board/columns", 1, ar::kTagFamilySize);
  f.board.rows = file.integer("board/rows", 1, ar::kTagFamilySize);
  f.board.tag_size = kMm * file.number("board/tag_size_mm", 2, 2000);
  f.board.spacing = kMm * file.number("board/spacing_mm", 0.1, 2000);
  f.width_spread = file.number("found/width_spread_px", 1e-3, 1000);
  f.width_lasting = file.number("found/lasting_share", 0, 1);
  f.aside = file.numbers("aside");
  requireRising(file, "aside", f.aside.size(), [&](std::size_t i) { return f.aside[i]; });
  for (const JsonFile& entry : file.entries("distances"))
    f.distances.push_back(readDistance(entry, f.aside.size()));
  requireRising(file, "distances", f.distances.size(),
                [&](std::size_t i) { return f.distances[i].distance; });
  return f;
}

namespace {

using nlohmann::json;

/// As a file shows it: what is finer than a ten-thousandth of a pixel is chance.
double rounded(double x) { return std::round(1e4 * x) / 1e4; }

json listOf(const std::vector<double>& values) {
  json all = json::array();
  for (const double x : values) all.push_back(rounded(x));
  return all;
}

template <class Groups>
json listOf(const Groups& groups) {
  json all = json::array();
  for (const Vector6& group : groups)
    for (const double x : group) all.push_back(rounded(x));
  return all;
}

}  // namespace

json jsonOf(const TrackingFigures& f) {
  json distances = json::array();
  for (const TrackingFigures::Distance& d : f.distances)
    distances.push_back({{"distance_mm", rounded(d.distance / kMm)},
                         {"corner_sigma_px", rounded(d.corner_sigma)},
                         {"strength", listOf(d.strength)},
                         {"least_width_px", listOf(d.least_width)},
                         {"bias_px", listOf(d.bias)},
                         {"lasting_px", listOf(std::array<Vector6, 1>{d.lasting})},
                         {"white_px", listOf(std::array<Vector6, 1>{d.white})},
                         {"wander_px", listOf(d.wander)}});
  return {
      {"version", kVersion},
      {"camera",
       {{"width_px", f.width}, {"height_px", f.height}, {"fx_px", f.fx}, {"decimate", f.decimate}}},
      {"board",
       {{"columns", f.board.columns},
        {"rows", f.board.rows},
        {"tag_size_mm", rounded(f.board.tag_size / kMm)},
        {"spacing_mm", rounded(f.board.spacing / kMm)}}},
      {"found",
       {{"width_spread_px", rounded(f.width_spread)}, {"lasting_share", rounded(f.width_lasting)}}},
      {"aside", f.aside},
      {"distances", distances}};
}

namespace {

/// Throws UsageError unless the station's camera, board and distance are those of the figures.
void requireFigures(const TrackingFigures& f, const station::Station& station) {
  constexpr double kSameFocal = 0.05, kSame = 1e-6;  // shares
  const auto same = [](double a, double b, double share) {
    return std::abs(a - b) <= share * std::abs(b);
  };
  const calibration::CameraModel& camera = station.design.camera;
  const ar::TagGridSpec &a = station.board, &b = f.board;
  const double distance = kMm * station.file.number("twin/camera_distance_mm", 100, 3000);
  const std::string& name = station.file.name();
  if (distance < f.distances.front().distance || distance > f.distances.back().distance)
    throw UsageError("is where the tracking model was not measured",
                     name + ", twin/camera_distance_mm", "Leave out --tracking model");
  const char* other = nullptr;
  if (camera.width != f.width || camera.height != f.height || !same(camera.fx, f.fx, kSameFocal) ||
      !same(station.decimate, f.decimate, kSame))
    other = "camera";
  else if (a.columns != b.columns || a.rows != b.rows || !same(a.tag_size, b.tag_size, kSame) ||
           !same(a.spacing, b.spacing, kSame) || a.border_bits != b.border_bits ||
           a.corner_squares != b.corner_squares)
    other = "board";
  if (other)
    throw UsageError("is another than the one whose pictures the tracking model was measured on",
                     name + ", " + other,
                     "Leave out --tracking model, or measure them (palpa bench tracking --fit FILE "
                     "--station " +
                         name + ") and name that file in the station: twin/tracking_figures");
}

}  // namespace

std::filesystem::path trackingFigureFile(const station::Station& station) {
  constexpr const char* kField = "twin/tracking_figures";
  if (!station.file.has(kField)) return station::assetFile("tracking/virtual_camera.json");
  return std::filesystem::path(station.file.name()).parent_path() / station.file.text(kField);
}

TrackingFigures trackingFiguresOf(const station::Station& station) {
  TrackingFigures figures = readTrackingFigures(trackingFigureFile(station));
  requireFigures(figures, station);
  return figures;
}

bool isInPicture(const std::array<Eigen::Vector2d, 4>& corners,
                 const calibration::CameraModel& camera) {
  return std::all_of(corners.begin(), corners.end(), [&](const Eigen::Vector2d& q) {
    return q.x() >= -0.5 && q.y() >= -0.5 && q.x() <= camera.width - 0.5 &&
           q.y() <= camera.height - 0.5;
  });
}

double narrowest(const std::array<Eigen::Vector2d, 4>& q) {
  double longest = 1, area2 = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d &a = q[i], &b = q[(i + 1) % 4];
    longest = std::max(longest, (b - a).norm());
    area2 += a.x() * b.y() - a.y() * b.x();
  }
  return std::abs(area2) / 2 / longest;
}

namespace {

/// rad: how far a wave turns on the way.
double turnOf(std::size_t wave, const Eigen::Vector2d& way) {
  constexpr std::array<double, 6> kPerTwoPixels{1, 2, 3, 4, 6, 8};
  const std::size_t n = kPerTwoPixels.size();
  return std::numbers::pi * kPerTwoPixels[wave % n] * (wave < n ? way.x() : way.y());
}

}  // namespace

PixelWave::PixelWave(RandomStream& random, std::size_t wave)
    : wave_(wave), cosine_(random.normal()), sine_(random.normal()) {}

double PixelWave::at(const Eigen::Vector2d& pixel) const {
  const double turn = turnOf(wave_, pixel);
  return cosine_ * std::cos(turn) + sine_ * std::sin(turn);
}

double PixelWave::correlation(std::size_t wave, const Eigen::Vector2d& apart) {
  return std::cos(turnOf(wave, apart));
}

TrackingModel::TrackingModel(const TrackingFigures& figures, const calibration::CameraModel& truth,
                             std::uint64_t seed)
    : figures_(figures), truth_(truth), seed_(seed) {
  RandomStream random(seed, "bench.tracking_model");
  for (int i = 0; i < 6; ++i) {
    lasting_[i] = random.normal();
    for (std::size_t wave = 0; wave < TrackingFigures::kWaves; ++wave)
      wander_.emplace_back(random, wave);
  }
  for (int i = 0; i < figures.board.columns * figures.board.rows; ++i)
    tag_pixels_.push_back({PixelWave(random, 1), PixelWave(random, 7)});
}

std::vector<TrackingModel::Corner> TrackingModel::foundCorners(const Pose& X_CW, double least_width,
                                                               RandomStream& random) const {
  const TrackingFigures& f = figures_;
  std::vector<Corner> all;
  for (int i = 0; i < f.board.columns * f.board.rows; ++i) {
    const double chance = random.normal();  // drawn for every tag, so that none shifts the others'
    const std::array<Vec3, 4> places = ar::tagCorners(f.board, f.board.first_id + i);
    std::array<ar::SeenPoint, 4> seen;
    std::array<Eigen::Vector2d, 4> pixels;
    for (std::size_t c = 0; c < 4; ++c) {
      seen[c] = ar::seenPoint(X_CW, places[c], truth_);
      pixels[c] = seen[c].pixel;
    }
    const auto& [along, across] = tag_pixels_[std::size_t(i)];
    const double luck =
        std::sqrt(f.width_lasting / 2) * (along.at(pixels[0]) + across.at(pixels[0])) +
        std::sqrt(1 - f.width_lasting) * chance;
    const bool wide = narrowest(pixels) > least_width + f.width_spread * luck;
    if (!wide || !isInPicture(pixels, truth_)) continue;
    for (std::size_t c = 0; c < 4; ++c) all.push_back({places[c], seen[c]});
  }
  return all;
}

namespace {

/// Where x lies among rising numbers: the entry before it, and the share of the way to the next.
template <class Of>
std::pair<std::size_t, double> placeAmong(std::size_t n, double x, Of of) {
  std::size_t i = 0;
  while (i + 2 < n && x >= of(i + 1)) ++i;
  return {i, std::clamp((x - of(i)) / (of(i + 1) - of(i)), 0.0, 1.0)};
}

}  // namespace

TrackingFigures::Distance TrackingModel::figuresAt(const Pose& X_CW) const {
  const Vec3 p_WC = X_CW.inverse().translation();
  const auto [i, farther] = placeAmong(figures_.distances.size(), p_WC.norm(), [&](std::size_t k) {
    return figures_.distances[k].distance;
  });
  const auto [j, beyond] = placeAmong(figures_.aside.size(), p_WC.x() / p_WC.norm(),
                                      [&](std::size_t k) { return figures_.aside[k]; });
  const TrackingFigures::Distance &a = figures_.distances[i], &b = figures_.distances[i + 1];
  const auto mixed = [t = farther](const auto& x, const auto& y) { return (1 - t) * x + t * y; };
  const auto placed = [&, j = j, u = beyond](const auto& x, const auto& y) {
    return mixed((1 - u) * x[j] + u * x[j + 1], (1 - u) * y[j] + u * y[j + 1]);
  };
  TrackingFigures::Distance here;
  here.distance = p_WC.norm();
  here.corner_sigma = mixed(a.corner_sigma, b.corner_sigma);
  here.least_width = {placed(a.least_width, b.least_width)};
  here.strength = {placed(a.strength, b.strength)};
  here.bias = {Vector6::Zero()};
  for (Eigen::Index k = 0; k < 6; ++k) {
    const auto bias = [k, j = j, u = beyond](const TrackingFigures::Distance& d) {
      return (1 - u) * d.bias[j][k] + u * d.bias[j + 1][k];
    };
    here.bias.front()[k] = mixed(bias(a), bias(b));
    here.lasting[k] = mixed(a.lasting[k], b.lasting[k]);
    here.white[k] = mixed(a.white[k], b.white[k]);
    for (std::size_t h = 0; h < TrackingFigures::kWaves; ++h)
      here.wander[h][k] = mixed(a.wander[h][k], b.wander[h][k]);
  }
  return here;
}

Vector6 TrackingModel::error(const Pose& X_CW, const TrackingFigures::Distance& here,
                             RandomStream& random) const {
  constexpr std::size_t kWaves = TrackingFigures::kWaves;
  const Eigen::Vector2d origin = truth_.project(X_CW.translation());
  const double strength = here.strength.front();
  Vector6 z = here.bias.front() + strength * here.lasting.cwiseProduct(lasting_);
  for (std::size_t k = 0; k < 6; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    z[axis] += here.white[axis] * random.normal();
    for (std::size_t h = 0; h < kWaves; ++h)
      z[axis] += strength * here.wander[h][axis] * wander_[k * kWaves + h].at(origin);
  }
  return z;
}

std::vector<ar::BoardPoint> TrackingModel::found(const Pose& X_CW, std::uint64_t number) const {
  RandomStream random(picture::randomBits(seed_, number), "bench.tracking_model.picture");
  const TrackingFigures::Distance here = figuresAt(X_CW);
  const std::vector<Corner> corners = foundCorners(X_CW, here.least_width.front(), random);
  const Vector6 z = error(X_CW, here, random);
  Matrix6 A = Matrix6::Zero();
  Vector6 b = Vector6::Zero();
  std::vector<Eigen::Vector2d> misses;
  for (const Corner& corner : corners) {
    misses.push_back(here.corner_sigma * Eigen::Vector2d(random.normal(), random.normal()));
    A += corner.seen.by_pose.transpose() * corner.seen.by_pose;
    b += corner.seen.by_pose.transpose() * misses.back();
  }
  std::vector<ar::BoardPoint> points;
  const Eigen::LLT<Matrix6> information(A);
  if (corners.empty() || information.info() != Eigen::Success) return points;
  // Moved by z, and by what takes back how the misses would move the pose.
  const Pose X_seen =
      ar::stepped(X_CW, Vector6(information.matrixU().solve(z) - information.solve(b)));
  for (std::size_t k = 0; k < corners.size(); ++k)
    points.push_back({corners[k].p_W, truth_.project(X_seen * corners[k].p_W) + misses[k]});
  return points;
}

}  // namespace palpa::twin
