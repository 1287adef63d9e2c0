#include "anatomy/import/import_patient.h"

#include <algorithm>
#include <map>

#include "anatomy/base/error.h"
#include "anatomy/import/propose_landmarks.h"
#include "anatomy/import/surface_topology.h"

namespace palpa::anatomy {
namespace {

constexpr std::size_t kMostTriangles = 20'000'000;
constexpr std::size_t kLeastTriangles = 200;  // of a surface that is decimated
constexpr double kFarthestPoint = 3;          // m: what a patient file can hold

std::string namesOf(const std::vector<RawMesh>& meshes) {
  std::string names;
  for (std::size_t i = 0; i < meshes.size() && i < 8; ++i)
    names += (names.empty() ? "" : ", ") + meshes[i].name;
  return meshes.size() > 8 ? names + " ..." : names;
}

/// All surfaces of a file, or the one that the entry names, as one.
RawMesh chosen(const std::vector<RawMesh>& meshes, const MapEntry& entry,
               const std::string& where) {
  RawMesh all;
  all.name = entry.id;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (entry.mesh_name ? meshes[i].name != *entry.mesh_name
                        : entry.mesh_index && *entry.mesh_index != i)
      continue;
    const auto first = static_cast<Corner>(all.points.size());
    all.points.insert(all.points.end(), meshes[i].points.begin(), meshes[i].points.end());
    for (const Triangle& t : meshes[i].triangles)
      all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  if (all.triangles.empty())
    throw UsageError(
        "it has no surface " + (entry.mesh_name ? "\"" + *entry.mesh_name + "\""
                                                : "number " + std::to_string(*entry.mesh_index)),
        where, "It has " + namesOf(meshes));
  return all;
}

void keepLargestPiece(RawMesh* mesh, std::size_t* left_out) {
  Pieces pieces = piecesOf(mesh->triangles, mesh->points.size());
  std::map<Corner, std::size_t> size;
  for (const Triangle& t : mesh->triangles) ++size[pieces.root(t[0])];
  const auto largest = std::max_element(
      size.begin(), size.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const std::size_t before = mesh->triangles.size();
  std::erase_if(mesh->triangles,
                [&](const Triangle& t) { return pieces.root(t[0]) != largest->first; });
  *left_out = before - mesh->triangles.size();
}

/// Refuses a length that the entry's organ cannot have.
void refuseImplausible(const SurfaceReport& report, const MapEntry& entry,
                       const std::string& where) {
  if (plausibleLength(entry.organ, report.longest)) return;
  const auto likely = likelyUnit(entry.organ, report.longest / entry.unit.metres);
  throw UsageError("\"" + entry.id + "\" would be a " + name(entry.organ) + " of " +
                       lengthText(report.longest) + ", read in " + entry.unit.words,
                   where,
                   likely ? "It was probably written in " + std::string(likely->words) +
                                ": say \"unit\": \"" + likely->name + "\" (--unit " + likely->name +
                                ")"
                          : "In no unit that is known would it be one");
}

/// In A's axes, metres; only points in use.
TriangleMesh placed(const RawMesh& mesh, const MapEntry& entry, const std::string& where) {
  TriangleMesh result;
  constexpr Corner kUnused = 0xffffffffu;
  std::vector<Corner> number(mesh.points.size(), kUnused);
  const bool mirrored = !entry.axes.rightHanded();
  for (const Triangle& t : mesh.triangles) {
    Triangle n{};
    for (std::size_t k = 0; k < 3; ++k) {
      Corner& at = number[t[k]];
      if (at == kUnused) {
        at = static_cast<Corner>(result.points.size());
        result.points.push_back(entry.place(mesh.points[t[k]]));
        if (!result.points.back().allFinite())
          throw Error("\"" + entry.id + "\" has a point that is nowhere", where,
                      "Check scale and translate_mm");
      }
      n[k] = at;
    }
    if (mirrored) std::swap(n[1], n[2]);
    result.triangles.push_back(n);
  }
  return result;
}

class Importer {
 public:
  Importer(const ImportMap& map, const std::filesystem::path& folder, const ImportOptions& options,
           ImportReport* report)
      : map_(map), folder_(folder), options_(options), report_(*report) {}

  Patient run() {
    patient_.name = map_.name;
    patient_.side = map_.side;
    patient_.licence = map_.licence;
    patient_.source = map_.source;
    for (const MapEntry& entry : map_.entries) add(entry);
    decimate();
    patient_.landmarks = map_.landmarks;
    report_.landmarks = proposeLandmarks(&patient_);
    moveOrigin();
    return std::move(patient_);
  }

 private:
  /// A file's surfaces; the last file stays read, for entries that take one surface each of the
  /// same file.
  const std::vector<RawMesh>& read(const std::filesystem::path& file) {
    if (file != last_file_) last_ = readMeshFile(file);
    last_file_ = file;
    return last_;
  }

  void add(const MapEntry& entry) {
    const std::filesystem::path file = folder_ / entry.file;
    const std::string where = file.string();
    const RawMesh raw = chosen(read(file), entry, where);
    if ((triangles_ += raw.triangles.size()) > kMostTriangles)
      throw Error("with this file there are more than 20 million triangles", where,
                  "Take coarser surfaces or fewer");
    SurfaceReport done;
    done.id = entry.id;
    done.file = entry.file.string();
    done.unit = entry.unit.words;
    done.organ = entry.organ;
    done.metres = entry.unit.metres * entry.scale;
    done.before = checkSurface(raw);
    RawMesh mended = repaired(raw, &done.repair, options_.weld / done.metres);
    if (entry.largest_piece) keepLargestPiece(&mended, &done.left_out);
    done.after = checkSurface(mended);
    done.longest = done.metres * (done.after.high - done.after.low).maxCoeff();
    refuseImplausible(done, entry, where);
    patient_.organs.push_back({entry.id, entry.organ, placed(mended, entry, where), entry.rgba,
                               entry.licence, entry.source});
    report_.surfaces.push_back(std::move(done));
  }

  /// Each surface gets its share of the budget, small ones at least kLeastTriangles or what they
  /// have.
  std::vector<std::size_t> shares() const {
    std::vector<std::size_t> share;
    std::size_t all = 0, floors = 0;
    for (const OrganSurface& organ : patient_.organs) {
      const std::size_t count = organ.mesh.triangles.size();
      share.push_back(count);
      all += count;
      floors += std::min(count, kLeastTriangles);
    }
    if (options_.triangles == 0 || all <= options_.triangles) return share;
    if (floors > options_.triangles)
      throw UsageError("is " + std::to_string(options_.triangles), "--triangles",
                       "These surfaces need at least " + std::to_string(floors));
    const double ratio =
        static_cast<double>(options_.triangles - floors) / static_cast<double>(all - floors);
    for (std::size_t& count : share) {
      const std::size_t floor = std::min(count, kLeastTriangles);
      count = floor + static_cast<std::size_t>(ratio * static_cast<double>(count - floor));
    }
    return share;
  }

  void decimate() {
    const std::vector<std::size_t> share = shares();
    for (std::size_t i = 0; i < share.size(); ++i)
      patient_.organs[i].mesh =
          decimated(patient_.organs[i].mesh, share[i], &report_.surfaces[i].decimation);
  }

  void moveOrigin() {
    const auto notch = patient_.landmarks.find(landmark::kNotch);
    if (map_.origin)
      report_.origin = *map_.origin;
    else if (notch != patient_.landmarks.end())
      report_.origin = notch->second;
    else
      report_.landmarks.push_back("no notch: the origin is the files'");
    for (OrganSurface& organ : patient_.organs)
      for (Vec3& p : organ.mesh.points) {
        p -= report_.origin;
        if (p.cwiseAbs().maxCoeff() > kFarthestPoint)
          throw Error("\"" + organ.id + "\" lies more than 3 m from the origin", map_.name,
                      "Check unit, scale, translate_mm and origin");
      }
    for (auto& [key, p] : patient_.landmarks) {
      p -= report_.origin;
      if (p.cwiseAbs().maxCoeff() > kFarthestPoint)
        throw Error("the landmark \"" + key + "\" lies more than 3 m from the origin", map_.name,
                    "Check its unit and axes");
    }
  }

  const ImportMap& map_;
  std::filesystem::path folder_, last_file_;
  const ImportOptions& options_;
  ImportReport& report_;
  Patient patient_;
  std::vector<RawMesh> last_;
  std::size_t triangles_ = 0;
};

}  // namespace

Patient importPatient(const ImportMap& map, const std::filesystem::path& folder,
                      const ImportOptions& options, ImportReport* report) {
  *report = {};
  return Importer(map, folder, options, report).run();
}

namespace {

std::string joinedWords(const std::vector<std::string>& parts, const std::string& otherwise) {
  std::string all;
  for (const std::string& part : parts) all += (all.empty() ? "" : ", ") + part;
  return all.empty() ? otherwise : all;
}

void describe(const SurfaceReport& s, std::vector<std::string>* lines) {
  lines->push_back(s.id + ", " + name(s.organ) + ", " + lengthText(s.longest) + " long, from " +
                   s.file + " (in " + s.unit + ")");
  lines->push_back("    found: " + std::to_string(s.before.triangles) + " triangles, " +
                   joinedWords(findings(s.before), "sound"));
  std::vector<std::string> done = words(s.repair, s.metres);
  if (s.left_out > 0)
    done.push_back(std::to_string(s.left_out) + " triangles of smaller pieces left out");
  lines->push_back("    done: " + joinedWords(done, "nothing") +
                   (s.after.sound() ? "; sound now"
                                    : "; NOT CLOSED: " + joinedWords(findings(s.after), "open")));
  if (s.decimation.way != "none")
    lines->push_back("    decimated from " + std::to_string(s.decimation.before) + " to " +
                     std::to_string(s.decimation.after) + " triangles (" + s.decimation.way +
                     "): the original's points lie within " + lengthText(s.decimation.farthest) +
                     " of it, rms " + lengthText(s.decimation.rms));
}

}  // namespace

std::vector<std::string> words(const ImportReport& report) {
  std::vector<std::string> lines;
  std::size_t before = 0, after = 0, open = 0, welded = 0, holes = 0;
  double farthest_weld = 0, farthest = 0;
  for (const SurfaceReport& s : report.surfaces) {
    describe(s, &lines);
    before += s.before.triangles;
    after += s.decimation.after;
    open += !s.after.sound();
    welded += s.repair.welded_points;
    holes += s.repair.closed_holes;
    farthest_weld = std::max(farthest_weld, s.metres * s.repair.farthest_weld);
    farthest = std::max(farthest, s.decimation.farthest);
  }
  lines.push_back("Landmarks");
  for (const std::string& sentence : report.landmarks) lines.push_back("    " + sentence);
  lines.push_back("Together: " + std::to_string(report.surfaces.size()) + " surfaces, " +
                  std::to_string(before) + " triangles found, " + std::to_string(after) + " kept");
  lines.push_back("    " + std::to_string(holes) + " holes closed, " + std::to_string(welded) +
                  " points of seams joined" +
                  (welded ? ", none moved by more than " + lengthText(farthest_weld) : ""));
  lines.push_back("    decimation: " + (farthest > 0
                                            ? "no point of an original is farther than " +
                                                  lengthText(farthest) + " from its surface"
                                            : std::string("none")));
  lines.push_back("    " + (open ? std::to_string(open) + " of the surfaces could not be closed"
                                 : std::string("every surface is closed")));
  return lines;
}

}  // namespace palpa::anatomy
