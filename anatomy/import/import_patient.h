#pragma once

#include "anatomy/import/decimate.h"
#include "anatomy/import/import_map.h"
#include "anatomy/import/repair.h"
#include "anatomy/import/surface_topology.h"

namespace palpa::anatomy {

struct ImportOptions {
  std::size_t triangles = 300'000;  ///< of the whole patient; 0: as many as there are
  double weld = kWeldTolerance;     ///< m; 0: exact places only
};

/// What was done with one surface.
struct SurfaceReport {
  std::string id, file, unit;
  Organ organ = Organ::none;
  double metres = 1;           ///< of one unit of the file, scale and all
  double longest = 0;          ///< m, longest side of its box
  SurfaceCheck before, after;  ///< file's unit
  RepairReport repair;
  std::size_t left_out = 0;     ///< triangles of smaller pieces
  DecimationReport decimation;  ///< metres
};

struct ImportReport {
  std::vector<SurfaceReport> surfaces;
  std::vector<std::string> landmarks;  ///< sentences
  Vec3 origin = Vec3::Zero();          ///< m, where A's origin lies in the files' places
};

/// A patient of many mesh files. Each surface is read, checked, repaired, its length compared with
/// what its organ can have (UsageError with the likely unit), placed, decimated to its share of the
/// budget, given normals; landmarks are the map's, then those that the meshes show; the origin is
/// the map's, else the notch, else the files'. Files hold at most 20 million triangles together.
/// Throws Error or UsageError, each naming file or entry.
Patient importPatient(const ImportMap& map, const std::filesystem::path& folder,
                      const ImportOptions& options, ImportReport* report);

/// The same in plain sentences, a line each: every surface, then totals.
std::vector<std::string> words(const ImportReport& report);

}  // namespace palpa::anatomy
