#include "calibration/touch/object_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include "anatomy/base/error.h"

namespace palpa::calibration {
namespace {

constexpr std::size_t kFewestTouches = 6;
constexpr double kInterval = 1.95996;  // sd to either side: 95 %
// The grid of what is considered: reach by the touches' extent, spread and surplus of the logarithm
constexpr int kReaches = 11, kSpreads = 9, kSurpluses = 5;
constexpr double kShortest = 0.03, kFarthest = 1.2;
constexpr double kLeastSpread = 0.02, kMostSpread = 0.8;
constexpr double kLeastSurplus = 0.003, kMostSurplus = 0.08;
constexpr double kNegligible = 6;  // of the logarithm of the best one's probability

double twiceSmooth(double r) {
  const double s = std::sqrt(5.0) * r;
  return (1 + s + s * s / 3) * std::exp(-s);
}
double endlesslySmooth(double r) { return std::exp(-r * r / 2); }
using Likeness = double (*)(double);
constexpr Likeness kLikenesses[] = {twiceSmooth, endlesslySmooth};

double gridAt(double least, double most, int i, int count) {
  return least * std::pow(most / least, static_cast<double>(i) / (count - 1));
}

void checkTouches(const std::vector<TouchedPlace>& touches) {
  const auto refuse = [](const std::string& what, const std::string& advice) {
    throw Error(what, "the map of the object", advice);
  };
  if (touches.size() < kFewestTouches)
    refuse("rests on " + std::to_string(touches.size()) + " touches",
           "Touch the surface at " + std::to_string(kFewestTouches) + " places or more");
  for (const TouchedPlace& touch : touches)
    if (!touch.at.allFinite() || !std::isfinite(touch.ln) || !(touch.sd > 0))
      refuse("holds a touch that says nothing", "Leave it out");
}

Eigen::MatrixXd distances(const std::vector<TouchedPlace>& touches) {
  const auto n = static_cast<Eigen::Index>(touches.size());
  Eigen::MatrixXd apart(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      apart(i, j) =
          (touches[static_cast<std::size_t>(i)].at - touches[static_cast<std::size_t>(j)].at)
              .norm();
  return apart;
}

}  // namespace

ObjectMap::ObjectMap(std::vector<TouchedPlace> touches, double shared_sd)
    : touches_(std::move(touches)), shared_sd_(shared_sd) {
  checkTouches(touches_);
  const Eigen::MatrixXd apart = distances(touches_);
  if (!(apart.maxCoeff() > 0))
    throw Error("rests on one place alone", "the map of the object", "Touch it elsewhere, too");
  learn(apart);
}

std::optional<ObjectMap::Process> ObjectMap::processOf(const std::vector<TouchedPlace>& touches,
                                                       const Eigen::MatrixXd& likeness,
                                                       double spread, double reach,
                                                       double surplus) {
  const Eigen::Index n = likeness.rows();
  Eigen::MatrixXd K = spread * spread * likeness;
  Eigen::VectorXd told(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const TouchedPlace& touch = touches[static_cast<std::size_t>(i)];
    K(i, i) += touch.sd * touch.sd + surplus * surplus;
    told[i] = touch.ln;
  }
  const Eigen::LLT<Eigen::MatrixXd> factors(K);
  if (factors.info() != Eigen::Success) return std::nullopt;
  Process process;
  process.variance = spread * spread;
  process.reach = reach;
  process.lower = factors.matrixL();
  process.even = factors.solve(Eigen::VectorXd::Ones(n));
  process.ones = process.even.sum();
  process.mean = process.even.dot(told) / process.ones;
  process.pull = factors.solve(told) - process.mean * process.even;
  const double misfit = (told.array() - process.mean).matrix().dot(process.pull);
  process.weight =
      -0.5 * misfit - process.lower.diagonal().array().log().sum() - 0.5 * std::log(process.ones);
  return process;
}

void ObjectMap::learn(const Eigen::MatrixXd& apart) {
  double best = -1e300;
  std::vector<Process> all;
  const auto consider = [&](Likeness like, double reach) {
    const Eigen::MatrixXd likeness = apart.unaryExpr([&](double d) { return like(d / reach); });
    for (int s = 0; s < kSpreads; ++s)
      for (int t = 0; t < kSurpluses; ++t) {
        auto process = processOf(touches_, likeness, gridAt(kLeastSpread, kMostSpread, s, kSpreads),
                                 reach, gridAt(kLeastSurplus, kMostSurplus, t, kSurpluses));
        if (!process || process->weight < best - kNegligible) continue;
        process->like = like;
        best = std::max(best, process->weight);
        all.push_back(std::move(*process));
      }
  };
  for (const Likeness like : kLikenesses)
    for (int l = 0; l < kReaches; ++l)
      consider(like, apart.maxCoeff() * gridAt(kShortest, kFarthest, l, kReaches));
  double sum = 0;
  for (Process& process : all) {
    if (process.weight < best - kNegligible) continue;
    process.weight = std::exp(process.weight - best);
    sum += process.weight;
    processes_.push_back(std::move(process));
  }
  for (Process& process : processes_) {
    process.weight /= sum;
    reach_ += process.weight * process.reach;
  }
}

MapValue ObjectMap::at(const Eigen::Vector2d& p) const {
  const auto n = static_cast<Eigen::Index>(touches_.size());
  double mean = 0, square = 0;
  Eigen::VectorXd k(n);
  for (const Process& process : processes_) {
    for (Eigen::Index i = 0; i < n; ++i)
      k[i] = process.variance *
             process.like((touches_[static_cast<std::size_t>(i)].at - p).norm() / process.reach);
    const double middle = process.mean + k.dot(process.pull);
    const double explained = process.lower.triangularView<Eigen::Lower>().solve(k).squaredNorm();
    const double left = 1 - k.dot(process.even);  // what the mean's own uncertainty adds
    const double variance =
        std::max(process.variance - explained, 0.0) + left * left / process.ones;
    mean += process.weight * middle;
    square += process.weight * (variance + middle * middle);
  }
  const double sd = std::sqrt(std::max(square - mean * mean, 0.0) + shared_sd_ * shared_sd_);
  return {std::exp(mean), std::exp(mean - kInterval * sd), std::exp(mean + kInterval * sd), sd};
}

std::vector<Eigen::Vector2d> placesOf(const MappedArea& area) {
  const Eigen::Vector2d size = area.high - area.low;
  const int nx = std::max(1, static_cast<int>(std::lround(size.x() / area.step))),
            ny = std::max(1, static_cast<int>(std::lround(size.y() / area.step)));
  std::vector<Eigen::Vector2d> places;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i)
      places.push_back(area.low + Eigen::Vector2d(size.x() * i / nx, size.y() * j / ny));
  return places;
}

MapVerdict judge(const ObjectMap& map, const MappedArea& area, int next, double apart) {
  const double enough = std::log(1 + area.within) / kInterval;
  std::vector<std::pair<double, Eigen::Vector2d>> places;
  for (const Eigen::Vector2d& p : placesOf(area)) places.emplace_back(map.at(p).sd, p);
  MapVerdict verdict;
  const auto known = std::count_if(places.begin(), places.end(),
                                   [&](const auto& place) { return place.first <= enough; });
  verdict.known = static_cast<double>(known) / static_cast<double>(places.size());
  verdict.sure = verdict.known >= area.share;
  std::stable_sort(places.begin(), places.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& place : places) {
    const Eigen::Vector2d& p = place.second;
    if (static_cast<int>(verdict.next.size()) >= next) break;
    const bool taken =
        std::any_of(verdict.next.begin(), verdict.next.end(),
                    [&](const Eigen::Vector2d& q) { return (q - p).norm() < apart; });
    if (!taken) verdict.next.push_back(p);
  }
  return verdict;
}

}  // namespace palpa::calibration
