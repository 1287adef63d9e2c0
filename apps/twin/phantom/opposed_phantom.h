#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/twin/phantom/opposed_table.h"
#include "apps/twin/phantom/phantom_twin.h"

/// Simulated phantoms that are pinched from both sides, like a cheek between a finger inside and a
/// finger outside: a slab in a frame.
namespace palpa::twin {

struct OpposedPhantom {
  std::string name;
  SoftBlock block;
  OpposedTable table;
};

/// Phantoms of one file, in millimetres and kilopascal (assets/phantoms/opposed.json), without
/// their tables. Throws UsageError for fields that are missing or out of range.
struct OpposedFile {
  Fineness fineness;
  std::vector<OpposedPhantom> phantoms;
};
OpposedFile readOpposed(const std::filesystem::path& file);

/// Whether a file of phantoms is of this kind.
bool isOpposed(const std::filesystem::path& file);

/// Solves every phantom of a file and writes the tables, with the description they were made of.
/// Takes minutes for each. Throws Error.
void solveOpposed(const std::filesystem::path& file, const std::filesystem::path& out,
                  const std::function<void(const std::string& name, int done, int of)>& progress);

/// A file's phantoms with their tables from `tables`. Throws UsageError where these were made of
/// another description.
std::vector<OpposedPhantom> readSolvedOpposed(const std::filesystem::path& file,
                                              const std::filesystem::path& tables);

/// Such a phantom under two moving tools: elasticity from the elements, what else silicone does on
/// top. What each does to the other is less where they are not opposite, by 1/(1 + (distance/22
/// mm)^2), as the elements have it up to 8 mm. Frame P of SoftBlock.
class OpposedPhantomTwin {
 public:
  OpposedPhantomTwin(OpposedTable table, const SiliconeLaw& law)
      : table_(std::move(table)), contacts_{SiliconeContact(law), SiliconeContact(law)} {}
  /// The first tool's lowest point and the second's highest are at `tips` after another `dt`.
  std::array<PhantomTouch, 2> step(const std::array<Vec3, 2>& tips, double dt);
  double thickness() const { return table_.thickness; }

 private:
  OpposedTable table_;
  std::array<SiliconeContact, 2> contacts_;
};

/// About the slab's middle plane: what is below as if it were above.
inline Vec3 mirroredInSlab(const Vec3& p, double thickness) {
  return {p.x(), p.y(), -thickness - p.z()};
}

}  // namespace palpa::twin
