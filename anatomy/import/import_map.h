#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "anatomy/import/units_and_axes.h"
#include "anatomy/patient.h"

namespace palpa::anatomy {

/// One surface of a patient that is put together from files.
/// p_A = axes * (metres of unit * scale * p_file) + translate - origin of the map.
struct MapEntry {
  std::filesystem::path file;  ///< relative, inside the folder
  /// of its surfaces only this one; without name and index all of them
  std::optional<std::string> mesh_name;
  std::optional<std::size_t> mesh_index;
  std::string id;
  Organ organ = Organ::none;
  Unit unit{};
  FileAxes axes;
  double scale = 1;
  Vec3 translate = Vec3::Zero();          ///< m, left, posterior, superior
  std::array<float, 4> rgba{1, 1, 1, 1};  ///< white: the organ's usual colour
  bool largest_piece = false;  ///< pieces that do not hang together with the largest are left out
  std::string licence, source;

  Vec3 place(const Vec3& p_file) const {
    return axes.A_from_file * (unit.metres * scale * p_file) + translate;
  }
};

/// What a map file says. Its schema is in anatomy/import/README.md.
struct ImportMap {
  std::string name, licence, source;
  Side side = Side::right;
  std::vector<MapEntry> entries;
  std::map<std::string, Vec3> landmarks;  ///< m, axes of A, before the origin is moved
  std::optional<Vec3> origin;             ///< the same; without it the suprasternal notch
};

/// For what a map leaves open, or instead of its own defaults. What an entry says itself stands.
struct MapDefaults {
  std::string unit, axes;  ///< empty: the map's
};

/// Everything is checked: unknown fields, missing ones, ranges. Throws UsageError that names the
/// field.
ImportMap parseImportMap(const std::string& json, const std::string& where,
                         const MapDefaults& defaults = {});
ImportMap readImportMap(const std::filesystem::path& file, const MapDefaults& defaults = {});

}  // namespace palpa::anatomy
