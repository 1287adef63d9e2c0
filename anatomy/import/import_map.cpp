#include "anatomy/import/import_map.h"

#include <set>

#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_fields.h"
#include "anatomy/base/whole_file.h"
#include "anatomy/geometry/pose.h"

namespace palpa::anatomy {
namespace {

constexpr std::size_t kMostEntries = 1000;
constexpr double kFarthest = 1e6;      // of a landmark, in its file's unit
constexpr double kFarthest_mm = 5000;  // of a shift

Organ organField(JsonFields& fields) {
  const std::string given = fields.text("organ");
  const Organ organ = organFromName(given.c_str());
  if (organ != Organ::none && organ != Organ::fascia) return organ;
  std::string known;
  for (int i = 1; i < kOrganCount; ++i)
    if (static_cast<Organ>(i) != Organ::fascia)
      known += (known.empty() ? "" : ", ") + std::string(palpa::name(static_cast<Organ>(i)));
  fields.refuse("organ", "is \"" + given + "\"; known: " + known);
}

/// Unit and axes that hold where nothing nearer says otherwise.
struct Inherited {
  std::string unit, axes;
  bool left_handed = false;
};

Unit unitField(JsonFields& fields, const Inherited& inherited) {
  const std::string given = fields.textOr("unit", inherited.unit);
  if (given.empty())
    fields.refuse("unit", "is missing here and as a default; known: " + knownUnits());
  const std::optional<Unit> unit = unitNamed(given);
  if (!unit) fields.refuse("unit", "is \"" + given + "\"; known: " + knownUnits());
  return *unit;
}

/// A left-handed set of axes mirrors: right for a file from a program that counts so, wrong for any
/// other.
FileAxes axesField(JsonFields& fields, const Inherited& inherited) {
  const std::string given = fields.textOr("axes", inherited.axes);
  if (given.empty()) fields.refuse("axes", "is missing here and as a default, for example \"LPS\"");
  const std::optional<FileAxes> axes = axesNamed(given);
  if (!axes)
    fields.refuse(
        "axes",
        "is \"" + given +
            "\", not three letters for where +x, +y, +z point: one of L R, one of A P, one of S I");
  const bool left_handed =
      fields.flagOr("left_handed", !fields.find("axes") && inherited.left_handed);
  if (!axes->rightHanded() && !left_handed)
    fields.refuse("axes", "is \"" + given +
                              "\", a left-handed set: the patient would be mirrored. If the file "
                              "really counts so, say \"left_handed\": true");
  if (axes->rightHanded() && left_handed)
    fields.refuse("left_handed", "is true, but the axes \"" + given + "\" are right-handed");
  return *axes;
}

std::filesystem::path fileField(JsonFields& fields) {
  std::filesystem::path file = fields.text("file");
  bool leaves = file.is_absolute();
  for (const auto& part : file) leaves = leaves || part == "..";
  if (leaves) fields.refuse("file", "leads out of the folder");
  return file;
}

void meshField(JsonFields& fields, MapEntry* entry) {
  const nlohmann::json* mesh = fields.find("mesh");
  if (!mesh) return;
  if (mesh->is_string())
    entry->mesh_name = fields.text("mesh");
  else if (mesh->is_number_unsigned())
    entry->mesh_index = mesh->get<std::size_t>();
  else
    fields.refuse("mesh", "is neither a name nor a number from 0 on");
}

void colourField(JsonFields& fields, MapEntry* entry) {
  const nlohmann::json* colour = fields.find("colour");
  if (!colour) return;
  if (!colour->is_array() || (colour->size() != 3 && colour->size() != 4))
    fields.refuse("colour", "is not [red, green, blue] or with opacity");
  for (std::size_t i = 0; i < colour->size(); ++i) {
    if (!(*colour)[i].is_number()) fields.refuse("colour", "is not made of numbers");
    const double part = (*colour)[i].get<double>();
    if (!(part >= 0 && part <= 1)) fields.refuse("colour", "is not between 0 and 1");
    entry->rgba[i] = static_cast<float>(part);
  }
}

MapEntry entryFrom(JsonFields fields, const Inherited& inherited) {
  MapEntry entry;
  entry.file = fileField(fields);
  entry.id = fields.text("id");
  entry.organ = organField(fields);
  meshField(fields, &entry);
  entry.unit = unitField(fields, inherited);
  entry.axes = axesField(fields, inherited);
  entry.scale = fields.numberOr("scale", 1, 1e-6, 1e6);
  if (fields.find("translate_mm"))
    entry.translate = 1e-3 * unpack(fields.triple("translate_mm", kFarthest_mm));
  colourField(fields, &entry);
  const std::string pieces = fields.textOr("pieces", "all");
  if (pieces != "all" && pieces != "largest")
    fields.refuse("pieces", "is \"" + pieces + "\" instead of all or largest");
  entry.largest_piece = pieces == "largest";
  entry.licence = fields.textOr("licence", "");
  entry.source = fields.textOr("source", "");
  fields.textOr("why", "");
  fields.done();
  return entry;
}

/// A point with the unit and axes that it is said in; as p_A before the origin is moved.
Vec3 pointFrom(JsonFields fields, const Inherited& inherited) {
  const Unit unit = unitField(fields, inherited);
  const FileAxes axes = axesField(fields, inherited);
  const Vec3 at = unpack(fields.triple("at", kFarthest));
  fields.textOr("why", "");
  fields.done();
  return axes.A_from_file * (unit.metres * at);
}

void readEntries(JsonFields& fields, const Inherited& inherited, ImportMap* map) {
  const nlohmann::json& entries = fields.need("entries");
  if (!entries.is_array() || entries.empty())
    fields.refuse("entries", "is not a list with something in it");
  if (entries.size() > kMostEntries) fields.refuse("entries", "has more than 1000 entries");
  std::set<std::string> ids;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::string path = "entries[" + std::to_string(i) + "]";
    map->entries.push_back(entryFrom(JsonFields(entries[i], fields.file(), path), inherited));
    if (!ids.insert(map->entries.back().id).second)
      fields.refuse(path + ".id", "is \"" + map->entries.back().id + "\", which is there already");
  }
}

void readPoints(JsonFields& fields, const Inherited& inherited, ImportMap* map) {
  if (const nlohmann::json* landmarks = fields.find("landmarks")) {
    if (!landmarks->is_object()) fields.refuse("landmarks", "is not an object { }");
    for (const auto& [key, value] : landmarks->items()) {
      if (key.empty() || key.size() > 100)
        fields.refuse("landmarks", "has a name that is empty or longer than 100 letters");
      map->landmarks[key] =
          pointFrom(JsonFields(value, fields.file(), "landmarks." + printable(key)), inherited);
    }
  }
  if (const nlohmann::json* origin = fields.find("origin"))
    map->origin = pointFrom(JsonFields(*origin, fields.file(), "origin"), inherited);
}

}  // namespace

ImportMap parseImportMap(const std::string& json, const std::string& where,
                         const MapDefaults& defaults) {
  const nlohmann::json root = parseJson(json, where);
  JsonFields fields(root, where, "");
  if (fields.text("format") != "palpa-import-map")
    fields.refuse("format", "is not \"palpa-import-map\"");
  if (fields.numberOr("version", 0, 0, 1e9) != 1) fields.refuse("version", "is not 1");
  refuseUnknownFields(JsonFile(root, where), "patient_map");
  ImportMap map;
  map.name = fields.text("name");
  const std::string side = fields.text("side");
  if (side != "right" && side != "left")
    fields.refuse("side", "is \"" + side + "\" instead of right or left");
  map.side = side == "right" ? Side::right : Side::left;
  map.licence = fields.text("licence");
  map.source = fields.text("source");
  Inherited inherited{fields.textOr("unit", ""), fields.textOr("axes", ""),
                      fields.flagOr("left_handed", false)};
  if (!defaults.unit.empty()) inherited.unit = defaults.unit;
  if (!defaults.axes.empty()) inherited.axes = defaults.axes;
  fields.textOr("why", "");
  readEntries(fields, inherited, &map);
  readPoints(fields, inherited, &map);
  fields.done();
  return map;
}

ImportMap readImportMap(const std::filesystem::path& file, const MapDefaults& defaults) {
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(file, failure);
  if (failure)
    throw UsageError("cannot be read (" + whyUnread(failure) + ")", file.string(),
                     "Check the name");
  if (size > (4u << 20)) throw UsageError("is larger than 4 MiB", file.string(), "Check the name");
  const std::optional<std::string> text = readWhole(file);
  if (!text) throw UsageError("cannot be read", file.string(), "Check its permissions");
  return parseImportMap(*text, file.string(), defaults);
}

}  // namespace palpa::anatomy
