#include "calibration/touch/texture_model.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "anatomy/base/error.h"

namespace palpa::calibration {
namespace {

using haptics::kMostTextureForces;
using haptics::kMostTextureOrder;
using haptics::kMostTextureSpeeds;
constexpr char kTextureWhere[] = "texture identification";
constexpr std::size_t kPiece = 250;      // samples
constexpr double kSteady = 0.15;         // standard deviation over mean
constexpr double kLeastSeconds = 4;      // of a node
constexpr double kEvenStep = 0.01;       // of the step
constexpr double kCutShare = 1e-3;       // of samples at the very largest value, one beside another
constexpr double kSilent = 1e-5;         // N
constexpr double kAlone = 0.25;          // of a row with one figure: ln, how far pieces may lie
constexpr double kScattered_dB = 0.5;    // a level less sure than this is worth more strokes
constexpr double kLowestWidth_Hz = 4.6;  // of the third octave at 20 Hz

void requireSteps(double dt) {
  if (std::abs(dt - haptics::kTexturePeriod) <= kEvenStep * haptics::kTexturePeriod) return;
  throw Error("is recorded every " + std::to_string(1e3 * dt) + " ms", kTextureWhere,
              "Textures are modelled and rendered at 1 kHz: record at that rate, or convert the "
              "recording to it through a filter that removes what is above 500 Hz");
}

void requireSignal(const std::vector<TextureStroke>& strokes) {
  double largest = 0;
  std::size_t count = 0;
  for (const TextureStroke& stroke : strokes)
    for (const TextureSample& s : stroke) {
      if (!std::isfinite(s.f_n) || !std::isfinite(s.speed) || !std::isfinite(s.shake))
        throw Error("a sample is not a number", kTextureWhere, "Record again");
      largest = std::max(largest, std::abs(s.shake));
      ++count;
    }
  if (count < kPiece) throw Error("has too few samples", kTextureWhere, "Stroke for longer");
  if (largest < kSilent)
    throw Error("nothing shakes the tool", kTextureWhere,
                "Is the accelerometer connected, and does the tool touch?");
  std::size_t cut = 0;
  for (const TextureStroke& stroke : strokes)
    for (std::size_t i = 1; i < stroke.size(); ++i)
      cut += std::abs(stroke[i].shake) > 0.999 * largest && stroke[i].shake == stroke[i - 1].shake;
  if (static_cast<double>(cut) > kCutShare * static_cast<double>(count))
    throw Error("the acceleration is cut off at its largest value", kTextureWhere,
                "Set the accelerometer to a larger range, and record again");
}

void requireRow(const std::vector<double>& row, std::size_t most, const char* of) {
  bool good = !row.empty() && row.size() <= most && row.front() > 0;
  for (std::size_t i = 1; i < row.size(); ++i) good = good && row[i] > row[i - 1];
  if (!good)
    throw Error(std::string("the ") + of + " of the models must be 1 to " + std::to_string(most) +
                    " rising figures",
                kTextureWhere, "Correct them");
}

struct Steadiness {
  double mean = 0;
  bool steady = false;
};
Steadiness steadinessOf(const TextureStroke& stroke, std::size_t from,
                        double TextureSample::*figure) {
  double sum = 0, squares = 0;
  for (std::size_t i = from; i < from + kPiece; ++i) {
    sum += stroke[i].*figure;
    squares += stroke[i].*figure * (stroke[i].*figure);
  }
  const double n = static_cast<double>(kPiece), mean = sum / n,
               variance = std::max(squares / n - mean * mean, 0.0);
  return {mean, mean > 0 && std::sqrt(variance) <= kSteady * mean};
}

/// The figure of a row that is nearest by ratio, within half of the way to the next; else none: -1.
int nearestIn(const std::vector<double>& row, double value) {
  const double x = std::log(value);
  for (std::size_t i = 0; i < row.size(); ++i) {
    const double at = std::log(row[i]), below = i > 0 ? at - std::log(row[i - 1]) : 0,
                 above = i + 1 < row.size() ? std::log(row[i + 1]) - at : 0;
    const double down = i > 0 ? below / 2 : (above > 0 ? above / 2 : kAlone),
                 up = i + 1 < row.size() ? above / 2 : (below > 0 ? below / 2 : kAlone);
    if (x >= at - down && x < at + up) return static_cast<int>(i);
  }
  return -1;
}

using Run = std::vector<double>;
/// What was recorded near one node: runs of y, less their means; ln of each piece's power; sums of
/// ln F and ln v over pieces.
struct NodeData {
  std::vector<Run> runs;
  std::vector<double> ln_powers;
  double ln_force = 0, ln_speed = 0;
  std::size_t samples() const {
    std::size_t count = 0;
    for (const Run& run : runs) count += run.size();
    return count;
  }
};

Run leakySum(const TextureStroke& stroke) {
  Run y;
  double sum = 0;
  for (const TextureSample& s : stroke) {
    sum = haptics::kTextureLeak * sum + s.shake;
    y.push_back(sum);
  }
  return y;
}

void divide(const TextureStroke& stroke, const TextureGrid& grid, std::vector<NodeData>* nodes) {
  const Run y = leakySum(stroke);
  int before = -1;
  for (std::size_t from = kPiece; from + kPiece <= stroke.size(); from += kPiece) {
    const Steadiness f = steadinessOf(stroke, from, &TextureSample::f_n),
                     v = steadinessOf(stroke, from, &TextureSample::speed);
    const int row = f.steady && v.steady ? nearestIn(grid.forces, f.mean) : -1,
              column = row >= 0 ? nearestIn(grid.speeds, v.mean) : -1;
    const int at = column >= 0 ? row * static_cast<int>(grid.speeds.size()) + column : -1;
    const int last = before;
    before = at;
    if (at < 0) continue;
    NodeData& node = (*nodes)[static_cast<std::size_t>(at)];
    if (at != last || node.runs.empty()) node.runs.emplace_back();
    double power = 0;
    for (std::size_t i = from; i < from + kPiece; ++i) {
      node.runs.back().push_back(y[i]);
      power += y[i] * y[i];
    }
    node.ln_powers.push_back(std::log(std::max(power / kPiece, 1e-30)));
    node.ln_force += std::log(f.mean);
    node.ln_speed += std::log(v.mean);
  }
}

void removeMeans(NodeData& node) {
  for (Run& run : node.runs) {
    double mean = 0;
    for (const double y : run) mean += y / static_cast<double>(run.size());
    for (double& y : run) y -= mean;
  }
}

/// Reflection coefficients of all orders, and the power that is left at each.
struct BurgFit {
  std::vector<double> k, left;
};
BurgFit burg(const std::vector<Run>& runs, std::size_t order) {
  BurgFit fit;
  std::vector<Run> forward = runs, backward = runs;
  double power = 0, count = 0;
  for (const Run& run : runs)
    for (const double y : run) {
      power += y * y;
      ++count;
    }
  power /= count;
  fit.left.push_back(power);
  for (std::size_t m = 1; m <= order; ++m) {
    double across = 0, along = 0;
    for (std::size_t r = 0; r < runs.size(); ++r)
      for (std::size_t i = m; i < runs[r].size(); ++i) {
        const double f = forward[r][i], b = backward[r][i - 1];
        across += f * b;
        along += f * f + b * b;
      }
    const double k = along > 0 ? -2 * across / along : 0;
    for (std::size_t r = 0; r < runs.size(); ++r)
      for (std::size_t i = runs[r].size(); i-- > m;) {
        const double f = forward[r][i], b = backward[r][i - 1];
        forward[r][i] = f + k * b;
        backward[r][i] = b + k * f;
      }
    power *= 1 - k * k;
    fit.k.push_back(k);
    fit.left.push_back(power);
  }
  return fit;
}

std::size_t bestOrder(const std::vector<NodeData>& nodes, const std::vector<BurgFit>& fits) {
  std::size_t best = 2;
  double least = 0;
  for (std::size_t p = 2; p <= kMostTextureOrder; p += 2) {
    double criterion = 0;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      criterion += static_cast<double>(nodes[n].samples()) * std::log(fits[n].left[p]) +
                   2 * static_cast<double>(p);
    if (p > 2 && criterion >= least) continue;
    least = criterion;
    best = p;
  }
  return best;
}

/// Standard error of a node's level, dB.
double levelDoubt(const NodeData& node) {
  double sum = 0, squares = 0;
  const double n = static_cast<double>(node.ln_powers.size());
  for (const double p : node.ln_powers) {
    sum += p;
    squares += p * p;
  }
  const double variance = std::max(squares / n - sum * sum / (n * n), 0.0);
  return 10 / std::log(10.0) * std::sqrt(variance / n);
}

void requireStrokes(const std::vector<NodeData>& nodes, const TextureGrid& grid, double dt) {
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const double seconds = dt * static_cast<double>(nodes[n].samples());
    if (seconds >= kLeastSeconds) continue;
    const auto words = [](double value, const char* unit) {
      std::string text = std::to_string(value);
      return text.substr(0, text.find('.') + 3) + " " + unit;
    };
    throw Error("only " + words(seconds, "s") + " of steady strokes are near " +
                    words(grid.forces[n / grid.speeds.size()], "N") + " and " +
                    words(1e3 * grid.speeds[n % grid.speeds.size()], "mm/s"),
                kTextureWhere,
                "Stroke there for " + words(kLeastSeconds, "s") +
                    " or longer, evenly; or ask for models at fewer forces and speeds");
  }
}

/// Levels, reflection coefficients, and where each row and column lies.
void setLaw(const std::vector<NodeData>& nodes, const std::vector<BurgFit>& fits,
            haptics::TextureLaw* law) {
  std::vector<double> in_row(law->forces), in_column(law->speeds);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const std::size_t row = n / law->speeds, column = n % law->speeds;
    const double pieces = static_cast<double>(nodes[n].ln_powers.size());
    haptics::TextureNode& node = law->nodes[row][column];
    node.ln_rms = 0.5 * std::log(fits[n].left[0]);
    std::copy_n(fits[n].k.begin(), law->order, node.reflection.begin());
    in_row[row] += pieces;
    in_column[column] += pieces;
    law->ln_force[row] += nodes[n].ln_force;
    law->ln_speed[column] += nodes[n].ln_speed;
  }
  for (std::size_t i = 0; i < in_row.size(); ++i) law->ln_force[i] /= in_row[i];
  for (std::size_t i = 0; i < in_column.size(); ++i) law->ln_speed[i] /= in_column[i];
}

}  // namespace

TextureModel identifyTexture(const std::vector<TextureStroke>& strokes, double dt,
                             const TextureGrid& grid) {
  requireSteps(dt);
  requireRow(grid.forces, kMostTextureForces, "forces");
  requireRow(grid.speeds, kMostTextureSpeeds, "speeds");
  requireSignal(strokes);
  std::vector<NodeData> nodes(grid.forces.size() * grid.speeds.size());
  for (const TextureStroke& stroke : strokes) divide(stroke, grid, &nodes);
  requireStrokes(nodes, grid, dt);
  TextureModel found;
  found.law.largest = std::numeric_limits<double>::infinity();
  found.law.forces = static_cast<std::uint32_t>(grid.forces.size());
  found.law.speeds = static_cast<std::uint32_t>(grid.speeds.size());
  std::vector<BurgFit> fits;
  for (NodeData& node : nodes) {
    removeMeans(node);
    fits.push_back(burg(node.runs, kMostTextureOrder));
  }
  found.law.order = static_cast<std::uint32_t>(bestOrder(nodes, fits));
  setLaw(nodes, fits, &found.law);
  for (const NodeData& node : nodes) {
    found.seconds.push_back(dt * static_cast<double>(node.samples()));
    found.level_sd_dB = std::max(found.level_sd_dB, levelDoubt(node));
  }
  const double least = *std::min_element(found.seconds.begin(), found.seconds.end());
  found.lowest_band_sd_dB = 10 / std::log(10.0) / std::sqrt(kLowestWidth_Hz * least);
  if (found.level_sd_dB > kScattered_dB)
    found.advice = "Stroke for longer: how strong the texture is scatters from piece to piece.";
  return found;
}

std::vector<double> renderedTexture(const haptics::TextureLaw& law, const TextureStroke& stroke,
                                    double dt) {
  haptics::TextureState state;
  std::vector<double> force;
  for (const TextureSample& s : stroke)
    force.push_back(haptics::textureForce(law, s.f_n, Vec3(s.speed * dt, 0, 0), dt, &state));
  return force;
}

}  // namespace palpa::calibration
