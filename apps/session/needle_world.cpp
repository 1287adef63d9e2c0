#include "apps/session/needle_world.h"
#include "apps/runtime/clock.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "anatomy/base/error.h"
#include "anatomy/base/random.h"
#include "anatomy/base/sha256.h"
#include "anatomy/base/whole_file.h"
#include "anatomy/import/decimate.h"
#include "anatomy/import/mesh_file.h"
#include "anatomy/parametric/phantoms.h"
#include "anatomy/patient/patient_check.h"
#include "anatomy/patient/patient_file.h"
#include "apps/assess/needle/assess_trial.h"
#include "apps/os/file_access.h"
#include "apps/session/output_folder.h"
#include "apps/station/assets.h"
#include "apps/twin/needle_plan.h"

namespace palpa::session {
namespace {

/// The needle's way is straight down.
anatomy::Patient makeBlock(const SessionOptions& options, const task_needle::TaskSettings& task) {
  const SessionOptions as_made;
  const std::pair<const char*, bool> not_here[]{
      {"--patient", !options.patient.empty()},
      {"--patient-seed", options.patient_seed != as_made.patient_seed},
      {"--guide", options.guide}};
  for (const auto& [option, given] : not_here)
    if (given)
      throw UsageError("has no meaning for this task: a block is punctured, no patient", option,
                       "Leave it out");
  anatomy::Patient block = anatomy::phantomBlock(task.block->size, task.title);
  block.layers = task.block->layers;
  return block;
}

anatomy::Patient makePatient(const SessionOptions& options, const task_needle::TaskSettings& task) {
  if (task.block) return makeBlock(options, task);
  if (!options.patient.empty()) {
    anatomy::Patient patient = anatomy::readPatient(options.patient);
    anatomy::requireForNeedle(patient, options.patient);
    if (options.side == anatomy::Side::left &&
        patient.side != options.side)  // right is what is meant where nothing is said
      throw UsageError("is left, and this patient was built for the right side", "--side",
                       "Leave it out, or build the patient again: palpa patient build --side left");
    return patient;
  }
  anatomy::PatientParameters parameters = anatomy::drawParameters(
      anatomy::readPopulation(station::assetFile("patients/reference.json").string()), options.side,
      options.patient_seed);
  parameters.extent = anatomy::Extent::bust;  // as the phantom that lies behind the board
  return keptPatient(parameters);
}

task_needle::TaskSettings makeTask(const SessionOptions& options) {
  task_needle::TaskSettings task =
      task_needle::readTask(options.task.empty() ? station::assetFile("tasks/paracentesis.json")
                                                 : std::filesystem::path(options.task));
  if (options.expert_path.empty()) return task;
  if (task.goal)
    throw UsageError("has no meaning for this task: it has a goal of its own, no expert path",
                     "--expert-path", "Leave it out");
  task.expert_path = options.expert_path;
  return task;
}

station::Station makeStation(const SessionOptions& options) {
  station::Station station = station::readStation(
      options.station.empty() ? station::assetFile("stations/virtual_bench.json")
                              : std::filesystem::path(options.station));
  station::judgeAge(station, runtime::utcNow());
  if (!options.intrinsics.empty())
    station.camera = station.design.camera = calibration::readCameraModel(options.intrinsics);
  return station;
}

constexpr double kFarthestWall = 2;  // standard deviations: no wall that no needle passes

int surfaceIndex(const anatomy::Patient& patient, Organ organ) {
  for (std::size_t i = 0; i < patient.organs.size(); ++i)
    if (patient.organs[i].organ == organ) return static_cast<int>(i);
  return -1;
}

/// All surfaces of the file as one.
anatomy::TriangleMesh meshOf(const station::RealThing& thing) {
  anatomy::TriangleMesh mesh;
  for (const anatomy::RawMesh& part : anatomy::readMeshFile(thing.mesh)) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const Vec3& p : part.points) mesh.points.push_back(thing.metres * p);
    for (auto t : part.triangles)
      mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  anatomy::computeUnitNormals(&mesh);
  return mesh;
}

}  // namespace

NeedleWorld::NeedleWorld(const SessionOptions& options)
    : station(makeStation(options)),
      task(makeTask(options)),
      needle(station::readNeedleFile(task.materials)),
      patient(makePatient(options, task)),
      query(patient, anatomy::SurfaceQuery::Curvature::left_out),
      geometry(patient, query),
      landmarks(task.block ? std::nullopt : std::make_optional<anatomy::LandmarkFrame>(patient)) {
  for (const station::RealThing& thing : station.things) real_things.push_back(meshOf(thing));
  if (!options.record_only && !task.expert_path.empty()) {
    not_scored = anatomy::whyNotScored(patient, query);
    if (not_scored.empty()) {
      expert_path = calibration::readExpertPath(task.expert_path);
      taught_path = expert_path->onBody(assess::teachingLineOf(patient, query));
    }
  }
  X_WA = options.camera.empty() ? station::placePatient(patient, station.entry_W)
                                : station::placePatientOnBoard(patient);
  if (!options.camera.empty())  // the bench's device stands where it stood, relative to the patient
    for (Pose* X_WD : {&station.X_WD, &station.design.X_WD})
      *X_WD = X_WA * station::placePatient(patient, station.entry_W).inverse() * *X_WD;
  X_DA = station.X_WD.inverse() * X_WA;
}

haptics::TickConfig NeedleWorld::tickConfig() const {
  haptics::TickConfig config;
  config.materials = needle.materials;
  config.materials.skin.K_0 *= haptics::loadOf(station.tool_shape);
  config.coupling = station.coupling;
  config.safety = station.safety;
  config.passivity = station.passivity;
  config.X_ET = pack(station.X_ET);
  config.augmentations = station::onDevice(task.augmentations, station);
  return config;
}

/// A ball ends 2 mm before the line's end, so that it never bars the way to the vein.
task_needle::NeedleFixtures NeedleWorld::fixtures() const {
  constexpr double kClear = 0.002;  // m [chosen]
  task_needle::NeedleFixtures fixtures;
  if (!taught_path || !landmarks) return fixtures;
  const Vec3 from_A = landmarks->pointToA(taught_path->line_from_L),
             to_A = landmarks->pointToA(taught_path->line_to_L);
  fixtures.line_p_D = pack(Vec3(X_DA * to_A));
  fixtures.line_a_D = pack(Vec3(X_DA.linear() * (to_A - from_A).normalized()));
  std::size_t next = 0;
  for (const task_needle::KeepOutOrgan& organ : task.keep_out) {
    const int surface = surfaceIndex(patient, organ.organ);
    if (surface < 0) continue;
    const anatomy::SurfacePoint nearest = query.closest(surface, to_A);
    const Vec3 middle_A = nearest.p_A - organ.radius * nearest.n_A;
    const double radius = std::min(organ.radius + organ.margin, (middle_A - to_A).norm() - kClear);
    if (radius > 0) fixtures.kept_out[next++] = {pack(Vec3(X_DA * middle_A)), radius};
  }
  return fixtures;
}

twin::VisibleAnatomy NeedleWorld::visible(const twin::OperatorSkill& skill,
                                          bool knows_patient) const {
  twin::VisibleAnatomy v;
  v.entry_A = patient.landmark(anatomy::landmark::kEntry);
  v.normal_A = query.closest(surfaceIndex(patient, Organ::skin), v.entry_A).n_A;
  if (!landmarks) {
    v.aim_A = v.entry_A - skill.vein_distance * v.normal_A;
    v.vein_distance = skill.vein_distance;
    v.medial_A = Vec3::UnitX();
    v.posterior_A = Vec3::UnitY();
    v.cephalad_A = Vec3::UnitZ();
    return v;
  }
  v.aim_A = patient.landmark(anatomy::landmark::kSternalEndPosteriorSuperior) +
            landmarks->vectorToA(skill.aim_offset_L);
  v.vein_distance = skill.vein_distance;
  if (knows_patient) {
    const twin::SeenVein vein = twin::aimByPictures(patient, query, v.entry_A, v.aim_A);
    v.aim_A = vein.aim_A;
    v.vein_distance = (v.aim_A - v.entry_A).norm();
    v.most_lean = std::atan(0.5 * vein.radius / v.vein_distance);
  }
  v.medial_A = landmarks->vectorToA(Vec3::UnitX());
  v.posterior_A = landmarks->vectorToA(Vec3::UnitY());
  v.cephalad_A = landmarks->vectorToA(Vec3::UnitZ());
  return v;
}

task_needle::TrialPlan NeedleWorld::trial(training::Role role, std::uint64_t seed,
                                          bool force_feedback, bool augmented) const {
  task_needle::TrialPlan plan{role, seed, force_feedback, augmented, 0, {}};
  plan.puncture_force_N =
      RandomStream(seed, "skin.puncture").uniform(needle.puncture_low_N, needle.puncture_high_N);
  RandomStream walls(seed, "walls.puncture");
  for (std::size_t i = 0; i < plan.wall_scale.size(); ++i) {
    const double z = std::clamp(walls.normal(), -kFarthestWall, kFarthestWall);
    plan.wall_scale[i] = static_cast<float>(std::exp(needle.materials.walls[i].spread * z));
  }
  return plan;
}

namespace {

constexpr std::size_t kDigest = 64;  // hexadecimal digits; a line's end follows

/// All that a patient is built from, to the bit.
std::string textOf(const anatomy::PatientParameters& p) {
  static_assert(sizeof(p) == 13 * sizeof(double), "A new parameter must be part of the text, too");
  std::ostringstream text;
  text << std::hexfloat << static_cast<int>(p.side) << ' ' << p.seed << ' '
       << static_cast<int>(p.extent) << ' ' << static_cast<int>(p.sex);
  for (const double value :
       {p.height, p.bmi, p.vein_depth, p.vein_diameter, p.pleura_distance, p.clavicle_length,
        p.clavicle_thickness, p.layers.skin, p.layers.fat, p.layers.muscle})
    text << ' ' << value;
  return text.str();
}

/// Nullopt: nothing is kept, as asked for or because this user has no folder.
std::optional<std::filesystem::path> folderOfKept() {
  if (const char* folder = std::getenv("PALPA_CACHE"); folder && *folder)
    return folder == std::string_view("off")
               ? std::nullopt
               : std::optional(std::filesystem::path(folder) / "patients");
  try {
    return os::cacheFolder("") / "palpa" / "patients";
  } catch (const UsageError&) {
    return std::nullopt;
  }
}

std::string nameOfKept(const anatomy::PatientParameters& parameters) {
  return sha256(os::programStamp() + '\n' + textOf(parameters)) + ".glb";
}

/// One of ours, or what a program left of one that it could not finish; nothing else is removed.
bool isOfKept(const std::filesystem::path& file) {
  std::string name = file.filename().string();
  const bool unfinished = name[0] == '.';
  if (unfinished) name.erase(0, 1);
  const std::string ending = name.substr(std::min(kDigest, name.size()));
  return name.find_first_not_of("0123456789abcdef") == kDigest &&
         (unfinished ? ending.starts_with(".glb.part-") : ending == ".glb");
}

struct KeptFile {
  std::filesystem::file_time_type written;
  std::uintmax_t bytes;
  std::filesystem::path path;
};

/// Without those that another program has just removed.
std::vector<KeptFile> keptIn(const std::filesystem::path& folder) {
  std::vector<KeptFile> files;
  for (const std::filesystem::path& path : entriesOf(folder)) {
    std::error_code gone;
    if (!isOfKept(path) || !std::filesystem::is_regular_file(path, gone)) continue;
    const auto written = std::filesystem::last_write_time(path, gone);
    const std::uintmax_t bytes = gone ? 0 : std::filesystem::file_size(path, gone);
    if (!gone) files.push_back({written, bytes, path});
  }
  std::sort(files.begin(), files.end(), [](const KeptFile& a, const KeptFile& b) {
    return std::tie(a.written, a.path) < std::tie(b.written, b.path);
  });
  return files;
}

std::optional<anatomy::Patient> kept(const std::filesystem::path& file) {
  const std::optional<std::string> bytes = readWhole(file);
  if (!bytes || bytes->size() <= kDigest) return std::nullopt;
  const std::string_view glb = std::string_view(*bytes).substr(kDigest + 1);
  if (sha256(glb) != bytes->substr(0, kDigest)) return std::nullopt;
  return anatomy::patientOfGlb(glb, file.string());
}

void keep(const anatomy::Patient& patient, const std::filesystem::path& file) {
  os::makeFolders(file.parent_path());  // writing says what is wrong
  const std::string glb = anatomy::glbOf(patient, file.string());
  try {
    writeWhole(file, sha256(glb) + '\n' + glb, Lasts::no, Readers::owner);
  } catch (const Error&) {  // a full disk, a folder that is not ours: the next one builds it anew
  }
}

}  // namespace

void boundKept(const std::filesystem::path& folder, std::uintmax_t most_bytes) {
  const std::vector<KeptFile> files = keptIn(folder);
  std::uintmax_t bytes = 0;
  for (const KeptFile& file : files) bytes += file.bytes;
  for (const KeptFile& file : files) {
    if (bytes <= most_bytes) return;
    std::error_code gone;  // another program was sooner
    std::filesystem::remove(file.path, gone);
    bytes -= file.bytes;
  }
}

anatomy::Patient keptPatient(const anatomy::PatientParameters& parameters) {
  const std::optional<std::filesystem::path> folder = folderOfKept();
  if (!folder) return anatomy::buildPatient(parameters);
  const std::filesystem::path file = *folder / nameOfKept(parameters);
  if (std::optional<anatomy::Patient> patient = kept(file)) return *std::move(patient);
  anatomy::Patient patient = anatomy::buildPatient(parameters);
  keep(patient, file);
  boundKept(*folder, kMostKept_bytes);
  return patient;
}

}  // namespace palpa::session
