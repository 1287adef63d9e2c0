#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/twin/phantom/phantom_twin.h"

/// Simulated phantoms that are not the same everywhere: skin over fat, a stiff core, ribs below.
namespace palpa::twin {

/// A round tool's force anywhere on the flat top of a block, solved once with finite elements and
/// looked up from then on. Frame P of SoftBlock. What a SoftBlock holds is the same on both sides
/// of y = 0, so only y >= 0 is solved.
struct SurfaceTable {
  double tool_radius = 0.008;                ///< m
  double step = 0.008, depth_step = 1.5e-3;  ///< m
  /// Places on the line y = 0 to either side of x = 0, and lines y = step, ...; depth 1, 2, ...
  /// steps
  int sides = 0, depths = 0;
  std::vector<Vec3> cells;  ///< N, on the tool: [y][x][depth], x from -sides steps to sides steps

  /// Between the cells by cubic interpolation of force over depth^1.5, which goes on straight
  /// toward no depth. Beyond the last cells as there; deeper than the last one it grows as
  /// depth^1.5. Zero at depth <= 0.
  Vec3 at(const Eigen::Vector2d& p, double depth) const;
  double reach() const { return sides * step; }  ///< m: |x|, |y| that are solved
};
/// Throws Error.
SurfaceTable tabulate(const SoftBlock& block, SurfaceTable shape, const Fineness& fineness,
                      const Tabulated& progress = {});

/// Times SiliconeLaw::mu: `left` where x < 0, `right` where x > 0, smoothly in between.
struct RubbingSides {
  double left = 1, right = 1, across = 0.01;  ///< 1, 1, m
  double at(double x) const;
};

/// Whether a file of phantoms is of this kind.
bool isLayered(const std::filesystem::path& file);

struct LayeredPhantom {
  std::string name;
  SoftBlock block;
  RubbingSides rubs;
  SurfaceTable table;
};

/// Phantoms of one file, in millimetres and kilopascal (assets/phantoms/layered.json), without
/// their tables. Throws UsageError for fields that are missing or out of range.
struct LayeredFile {
  Fineness fineness;
  std::vector<LayeredPhantom> phantoms;
};
LayeredFile readLayered(const std::filesystem::path& file);

/// Solves every phantom of a file and writes the tables, with the description they were made of.
/// Takes a quarter of an hour for each. Throws Error.
void solveLayered(const std::filesystem::path& file, const std::filesystem::path& out,
                  const std::function<void(const std::string& name, int done, int of)>& progress);

/// A file's phantoms with their tables from `tables`. Throws UsageError where these were made of
/// another description.
std::vector<LayeredPhantom> readSolvedLayered(const std::filesystem::path& file,
                                              const std::filesystem::path& tables);

/// Such a phantom under a moving tool: elasticity from the elements, what else silicone does on
/// top.
class LayeredPhantomTwin {
 public:
  LayeredPhantomTwin(LayeredPhantom phantom, const SiliconeLaw& law)
      : phantom_(std::move(phantom)), contact_(law) {}
  /// The tool's lowest point is at `tip` after another `dt`.
  PhantomTouch step(const Vec3& tip, double dt);
  const LayeredPhantom& phantom() const { return phantom_; }

 private:
  LayeredPhantom phantom_;
  SiliconeContact contact_;
};

}  // namespace palpa::twin
