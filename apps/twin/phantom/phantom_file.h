#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "anatomy/base/json_file.h"
#include "apps/twin/phantom/phantom_twin.h"

namespace palpa::twin {

/// A simulated phantom: what it is, and what pressing it takes.
struct Phantom {
  std::string name;
  SoftBlock block;
  PhantomTable table;
  PairTable both;
};

/// Phantoms of one kind of silicone, in millimetres and kilopascal (see
/// assets/phantoms/mockups.json).
struct PhantomFile {
  PhantomTable shape;  ///< of the tables; no cells
  PairTable both;
  Fineness fineness;
  std::vector<Phantom> phantoms;  ///< without their tables
};
/// Throws UsageError for fields that are missing or out of range.
PhantomFile readPhantoms(const std::filesystem::path& file);

/// Solves every phantom of a file and writes the tables, with the description they were made of.
/// Takes minutes for each. Throws Error.
void solvePhantoms(const std::filesystem::path& file, const std::filesystem::path& out,
                   const std::function<void(const std::string& name, int done, int of)>& progress);

/// Silicone of another stiffness and another surface (assets/materials/surfaces.json), as it truly
/// is on the virtual bench.
struct SoftSurface {
  std::string name;
  double shear = 0;  ///< Pa
  SiliconeLaw law;
  /// A plain phantom, made of this: at the same ratio of bulk to shear modulus forces grow as the
  /// shear modulus does, and shapes stay, so that nothing has to be solved again.
  Phantom madeOf(Phantom plain) const;
};
/// Throws UsageError for fields that are missing or out of range.
std::vector<SoftSurface> readSoftSurfaces(const std::filesystem::path& file);

/// Throws UsageError where solved tables were made of another description than the file `name`.
void needMadeOf(const JsonFile& tables, const std::filesystem::path& name);

/// A file's phantoms with their tables from `tables`. Throws UsageError where these were made of
/// another description.
std::vector<Phantom> readSolved(const std::filesystem::path& file,
                                const std::filesystem::path& tables);

}  // namespace palpa::twin
