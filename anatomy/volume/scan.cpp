#include "anatomy/volume/scan.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"

namespace palpa::anatomy {
namespace {

constexpr double kAir = -300;            // HU
constexpr double kWorkingStep = 1.5e-3;  // m: reduced while a step stays below this
constexpr double kAboveShoulders = 0.12, kBelowShoulders = 0.20;
constexpr double kShoulderWidth = 0.8;  // of the widest slice
constexpr double kThinnest = 3e-3;      // table, clothes, tubes are thinner than twice this
constexpr double kThinWall = 15e-3;     // m, on from what is thicker
constexpr double kAirKept = 40e-3;      // of air kept about the body
constexpr double kSpeck = 1e-6;         // m^3
constexpr double kEnvelope = 18e-3;     // fat between muscles is narrower than twice this

/// Means over blocks.
Volume reduced(const Volume& v, const Index3& by) {
  Volume out;
  for (std::size_t a = 0; a < 3; ++a) {
    out.size[a] = std::max(1, v.size[a] / by[a]);
    out.steps_S.col(static_cast<int>(a)) = by[a] * v.steps_S.col(static_cast<int>(a));
  }
  out.origin_S = v.pointToS(Vec3(by[0] - 1, by[1] - 1, by[2] - 1) / 2);
  out.values.reserve(static_cast<std::size_t>(out.size[0]) * static_cast<std::size_t>(out.size[1]) *
                     static_cast<std::size_t>(out.size[2]));
  for (int k = 0; k < out.size[2]; ++k)
    for (int j = 0; j < out.size[1]; ++j)
      for (int i = 0; i < out.size[0]; ++i) {
        double sum = 0;
        for (int c = 0; c < by[2]; ++c)
          for (int b = 0; b < by[1]; ++b)
            for (int a = 0; a < by[0]; ++a)
              sum += v.at(i * by[0] + a, j * by[1] + b, k * by[2] + c);
        out.values.push_back(static_cast<float>(sum / (by[0] * by[1] * by[2])));
      }
  return out;
}

Volume slices(const Volume& v, int low, int high) {
  Volume out = v;
  out.size[2] = high - low;
  out.origin_S = v.pointToS(Vec3(0, 0, low));
  out.values.assign(v.values.begin() + static_cast<std::ptrdiff_t>(v.index(0, 0, low)),
                    v.values.begin() + static_cast<std::ptrdiff_t>(
                                           v.index(0, 0, high - 1) +
                                           v.index(0, 1, 0) * static_cast<std::size_t>(v.size[1])));
  return out;
}

/// The highest slice in which the soft tissue is nearly as wide as anywhere.
int shoulderSlice(const Volume& v, double level) {
  std::vector<int> width(static_cast<std::size_t>(v.size[2]), 0);
  for (int k = 0; k < v.size[2]; ++k) {
    int columns = 0;
    for (int i = 0; i < v.size[0]; ++i) {
      int filled = 0;
      for (int j = 0; j < v.size[1]; ++j) filled += v.at(i, j, k) > level;
      columns += filled * v.spacing()[1] > 0.03;  // more than a table's thickness
    }
    width[static_cast<std::size_t>(k)] = columns;
  }
  const int widest = *std::max_element(width.begin(), width.end());
  for (int k = v.size[2] - 1; k >= 0; --k)
    if (width[static_cast<std::size_t>(k)] >= kShoulderWidth * widest) return k;
  return v.size[2] - 1;
}

/// Pieces of at least a cubic centimetre.
Mask withoutSpecks(const VoxelGrid& grid, const Mask& mask) {
  const VoxelPieces pieces = piecesOf(grid, mask);
  Mask out(mask.size());
  for (std::size_t n = 0; n < mask.size(); ++n)
    out[n] =
        mask[n] && static_cast<double>(pieces.voxels[static_cast<std::size_t>(pieces.label[n])]) *
                           grid.spacing.prod() >
                       kSpeck;
  return out;
}

/// Soft tissue without table, clothes and specks: what is thick, and thin walls (between ribs) that
/// go on from it.
Mask tissueOf(const VoxelGrid& grid, const Mask& soft) {
  const Mask solid = filled(grid, soft, true);  // lungs, marrow: what is left is thin or body
  const Mask thick = withoutSpecks(grid, opened(grid, solid, kThinnest));
  std::vector<std::int32_t> markers(soft.size());
  for (std::size_t n = 0; n < soft.size(); ++n) markers[n] = soft[n] && thick[n];
  const std::vector<std::int32_t> reached = grown(grid, std::move(markers), soft, kThinWall);
  return Mask(reached.begin(), reached.end());
}

void findBody(Scan* scan) {
  const VoxelGrid& grid = scan->grid;
  Mask soft(scan->volume.values.size());
  for (std::size_t n = 0; n < soft.size(); ++n)
    soft[n] = scan->volume.values[n] > scan->levels.soft;
  if (scan->levels.clipped) {
    // What was lost to the window parts muscles, shoulders and clavicles from each other.
    scan->tissue = tissueOf(grid, soft);
    scan->body = filled(grid, largestPiece(grid, closed(grid, scan->tissue, kEnvelope)), true);
  } else {
    scan->body =
        filled(grid, largestPiece(grid, opened(grid, filled(grid, soft, true), kThinnest)), true);
    scan->tissue = std::move(soft);
  }
  for (std::size_t n = 0; n < scan->body.size(); ++n)
    scan->tissue[n] = scan->tissue[n] && scan->body[n];
}

/// Without the air, table and shelf beside the body.
void cropToBody(Scan* scan) {
  const VoxelGrid whole = scan->grid;
  Index3 low = whole.size, high{0, 0, 0};
  for (std::size_t n = 0; n < scan->body.size(); ++n) {
    if (!scan->body[n]) continue;
    const Index3 c = whole.cell(n);
    for (std::size_t a = 0; a < 3; ++a)
      low[a] = std::min(low[a], c[a]), high[a] = std::max(high[a], c[a] + 1);
  }
  Index3 size = whole.size;
  for (std::size_t a = 0; a < 2; ++a) {
    const int more = static_cast<int>(kAirKept / whole.spacing[static_cast<int>(a)]);
    low[a] = std::max(0, low[a] - more), high[a] = std::min(whole.size[a], high[a] + more);
    size[a] = high[a] - low[a];
  }
  low[2] = 0;
  if (size[0] < 2 || size[1] < 2) return;
  Scan out = *scan;
  out.volume.size = out.grid.size = size;
  out.volume.origin_S = scan->volume.pointToS(Vec3(low[0], low[1], 0));
  const std::size_t count = out.grid.count();
  out.volume.values.resize(count), out.body.resize(count), out.tissue.resize(count);
  for (std::size_t n = 0; n < count; ++n) {
    const Index3 c = out.grid.cell(n);
    const std::size_t from = whole.index({c[0] + low[0], c[1] + low[1], c[2]});
    out.volume.values[n] = scan->volume.values[from], out.body[n] = scan->body[from],
    out.tissue[n] = scan->tissue[from];
  }
  *scan = std::move(out);
}

double meanBone(const Scan& scan) {
  double sum = 0, count = 0;
  for (std::size_t n = 0; n < scan.body.size(); ++n)
    if (scan.body[n] && scan.volume.values[n] >= scan.levels.bone)
      sum += scan.place(n).x(), ++count;
  if (count == 0)
    throw Error("no bone is as bright as " + std::to_string(scan.levels.bone), "CT volume",
                "Give --bone-level, or take a CT volume");
  return sum / count;
}

}  // namespace

Levels levelsOf(const Volume& volume) {
  const auto [low, high] = std::minmax_element(volume.values.begin(), volume.values.end());
  Levels levels;
  levels.clipped = *low > kAir;
  if (!levels.clipped) return levels;
  const double range = *high - *low;
  levels.soft = *low + 0.02 * range;
  levels.bone = *low + 0.31 * range;
  levels.dense = *low + 0.85 * range;
  return levels;
}

Index3 Scan::cellAt(const Vec3& p_S) const {
  const Vec3 c = volume.pointToIndex(p_S);
  Index3 cell{};
  for (std::size_t a = 0; a < 3; ++a)
    cell[a] =
        std::clamp(static_cast<int>(std::lround(std::clamp(c[static_cast<int>(a)], -1e6, 1e6))), 0,
                   grid.size[a] - 1);
  return cell;
}

Mask Scan::above(double level) const {
  Mask out(body.size());
  for (std::size_t n = 0; n < out.size(); ++n) out[n] = body[n] && volume.values[n] >= level;
  return out;
}

Scan prepareScan(const Volume& given, const Levels& levels) {
  Volume v = alongBody(given);
  Index3 by{1, 1, 1};
  for (std::size_t a = 0; a < 3; ++a)
    by[a] = std::clamp(static_cast<int>(kWorkingStep / v.spacing()[static_cast<int>(a)]), 1,
                       std::max(1, v.size[a] / 8));
  if (by != Index3{1, 1, 1}) v = reduced(v, by);
  const int shoulders = shoulderSlice(v, levels.soft);
  const double step = v.spacing()[2];
  const int low = std::max(0, shoulders - static_cast<int>(kBelowShoulders / step));
  const int high = std::min(v.size[2], shoulders + static_cast<int>(kAboveShoulders / step) + 1);
  Scan scan;
  scan.volume = slices(v, low, high);
  scan.grid = gridOf(scan.volume);
  scan.levels = levels;
  findBody(&scan);
  cropToBody(&scan);
  scan.midline_x = meanBone(scan);
  return scan;
}

namespace {

constexpr double kClearOff = 0.003, kClearRatio = 1.6, kSpineHalf = 0.035, kBeside = 0.06;
constexpr double kEnds = 0.3;  // of the height

char turned(char letter) {
  switch (letter) {
    case 'P':
      return 'A';
    case 'A':
      return 'P';
    case 'S':
      return 'I';
    case 'I':
      return 'S';
    default:
      return letter;
  }
}

struct Found {
  double spine_behind = 0;      ///< metres
  double above = 0, below = 0;  ///< bone beside the spine near either end
};

Found look(const Volume& volume, const Levels& levels) {
  const double stride_mm = 3;
  Index3 by{};
  for (std::size_t a = 0; a < 3; ++a)
    by[a] = std::max(1, static_cast<int>(stride_mm * 1e-3 / volume.spacing()[static_cast<int>(a)]));
  struct Sum {
    double x = 0, y = 0, count = 0;
  } soft, spine;
  const auto visit = [&](auto use) {
    for (int k = 0; k < volume.size[2]; k += by[2])
      for (int j = 0; j < volume.size[1]; j += by[1])
        for (int i = 0; i < volume.size[0]; i += by[0])
          use(volume.at(i, j, k), volume.pointToS(Vec3(i, j, k)));
  };
  visit([&](double value, const Vec3& p) {
    if (value > levels.soft) soft.x += p.x(), soft.y += p.y(), ++soft.count;
  });
  if (soft.count == 0) return {};
  const double middle = soft.x / soft.count;
  const Vec3 one = volume.pointToS(Vec3::Zero());
  const Vec3 other =
      volume.pointToS(Vec3(volume.size[0] - 1, volume.size[1] - 1, volume.size[2] - 1));
  const double low = std::min(one.z(), other.z()), height = std::abs(one.z() - other.z());
  Found found;
  visit([&](double value, const Vec3& p) {
    if (value < levels.bone) return;
    const double off = std::abs(p.x() - middle), up = (p.z() - low) / height;
    if (off < kSpineHalf) spine.y += p.y(), ++spine.count;
    if (off > kBeside && up > 1 - kEnds) ++found.above;
    if (off > kBeside && up < kEnds) ++found.below;
  });
  if (spine.count > 0) found.spine_behind = spine.y / spine.count - soft.y / soft.count;
  return found;
}

}  // namespace

std::string probableFlip(const Volume& volume, const Levels& levels) {
  const Found found = look(volume, levels);
  const bool front = found.spine_behind<-kClearOff, down = found.below> kClearRatio * found.above;
  if (!front && !down) return "";
  std::string axes = axesOf(volume);
  for (char& letter : axes)
    if ((front && (letter == 'A' || letter == 'P')) || (down && (letter == 'S' || letter == 'I')))
      letter = turned(letter);
  return std::string("The body seems to lie otherwise than the header says (") +
         (front ? "the spine is in front" : "") + (front && down ? ", " : "") +
         (down ? "the shoulders are below" : "") +
         "): look at the previews, and if so add --ct-axes " + axes +
         (front != down ? " --ct-mirrored" : "");
}

}  // namespace palpa::anatomy
