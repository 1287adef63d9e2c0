#include <cstdio>
#include <map>
#include <memory>
#include <optional>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "anatomy/import/import_patient.h"
#include "anatomy/import/repair.h"
#include "anatomy/import/surface_topology.h"
#include "anatomy/import/units_and_axes.h"
#include "anatomy/parametric/parametric_patient.h"
#include "anatomy/patient/patient_check.h"
#include "anatomy/patient/patient_file.h"
#include "apps/cli/arguments.h"
#include "apps/cli/commands.h"
#include "apps/cli/patient_sources.h"
#include "apps/cli/values.h"
#include "apps/station/assets.h"
#include "scene/view/anatomical_plate.h"
#include "scene/view/contact_sheet.h"
#include "scene/view/scene_view.h"

namespace palpa::cli {
namespace {

struct PatientOptions {
  std::string file, side = "right", out = "patient.glb", unit, organ;
  std::string sex;
  double height = 0, bmi = 0;  ///< 0: not stated
  PhantomOptions phantom;
  std::uint64_t seed = 0;
};

anatomy::Person personOf(const PatientOptions& o) {
  anatomy::Person person;
  if (!o.sex.empty()) person.sex = o.sex == "f" ? anatomy::Sex::female : anatomy::Sex::male;
  if (o.height != 0) person.height = o.height;
  if (o.bmi != 0) person.bmi = o.bmi;
  return person;
}

struct ImportCommand {
  std::string folder, map, out = "patient.glb", unit, axes;
  int triangles = 300'000;
  double weld_mm = 1e3 * anatomy::kWeldTolerance;
};

anatomy::Patient build(const PatientOptions& o) {
  if (!o.phantom.kind.empty()) return buildPhantom(o.phantom);
  return anatomy::buildPatient(anatomy::drawParameters(
      anatomy::readPopulation(station::assetFile("patients/reference.json").string()),
      o.side == "left" ? anatomy::Side::left : anatomy::Side::right, o.seed, personOf(o)));
}

void printPatient(const anatomy::Patient& patient) {
  std::printf("%s, %s side\n", patient.name.c_str(), anatomy::name(patient.side));
  std::size_t triangles = 0;
  for (const anatomy::OrganSurface& organ : patient.organs) {
    triangles += organ.mesh.triangles.size();
    std::printf("  %-28s %-9s %6zu triangles\n", organ.id.c_str(), name(organ.organ),
                organ.mesh.triangles.size());
  }
  std::printf(
      "  %zu triangles in all\nLandmarks (mm: left, posterior, superior of the suprasternal "
      "notch)\n",
      triangles);
  for (const auto& [landmark, p] : patient.landmarks)
    std::printf("  %-44s %7.1f %7.1f %7.1f\n", landmark.c_str(), 1e3 * p.x(), 1e3 * p.y(),
                1e3 * p.z());
  const std::vector<std::string> missing = anatomy::missingForNeedle(patient);
  if (!missing.empty()) std::printf("To be looked at, not to be punctured: it lacks\n");
  for (const std::string& one : missing) std::printf("  %s\n", one.c_str());
  if (!missing.empty()) return;
  std::printf("Checks\n");
  for (const auto& finding : anatomy::checkPatient(patient))
    std::printf("  %-4s %-52s %8.2f %s\n", finding.ok ? "ok" : "BAD", finding.name.c_str(),
                finding.value, finding.unit.c_str());
}

/// Throws UsageError for a unit that nobody knows.
anatomy::Unit unitOf(const PatientOptions& o) {
  const std::optional<anatomy::Unit> unit = anatomy::unitNamed(o.unit.empty() ? "m" : o.unit);
  if (!unit) throw UsageError("is \"" + o.unit + "\"", "--unit", "Known: " + anatomy::knownUnits());
  return *unit;
}

struct CheckedSurface {
  anatomy::RawMesh mesh;
  anatomy::SurfaceCheck check;
};

/// Refuses a length that the named organ cannot have.
void checkLength(const CheckedSurface& surface, const PatientOptions& o, Organ organ) {
  const auto& [mesh, check] = surface;
  const double in_file = (check.high - check.low).maxCoeff(), longest = unitOf(o).metres * in_file;
  if (anatomy::plausibleLength(organ, longest)) return;
  const auto likely = anatomy::likelyUnit(organ, in_file);
  throw UsageError("would be a " + std::string(name(organ)) + " of " + anatomy::lengthText(longest),
                   o.file + ", \"" + mesh.name + "\"",
                   likely ? "It was probably written in " + std::string(likely->words) +
                                ": add --unit " + likely->name
                          : "It would not be one in any known unit");
}

/// Whether it can be mended, and what would be done.
void printRepair(const anatomy::RawMesh& mesh, double metres) {
  anatomy::RepairReport report;
  const bool sound =
      anatomy::checkSurface(anatomy::repaired(mesh, &report, anatomy::kWeldTolerance / metres))
          .sound();
  std::string done;
  for (const std::string& word : anatomy::words(report, metres))
    done += (done.empty() ? "" : ", ") + word;
  std::printf("      %s: %s\n", sound ? "can be repaired" : "cannot be repaired entirely",
              done.empty() ? "nothing helps" : done.c_str());
}

/// What a surface is worth, in plain words.
void printSurface(const CheckedSurface& surface, const PatientOptions& o) {
  const auto& [mesh, check] = surface;
  const Vec3 size = unitOf(o).metres * (check.high - check.low);
  std::printf("  %-40s %8zu triangles  %s x %s x %s  %s\n", mesh.name.c_str(), check.triangles,
              anatomy::lengthText(size.x()).c_str(), anatomy::lengthText(size.y()).c_str(),
              anatomy::lengthText(size.z()).c_str(), check.sound() ? "sound" : "see below");
  if (check.pieces > 1) std::printf("      in %zu pieces\n", check.pieces);
  for (const std::string& finding : anatomy::findings(check))
    std::printf("      %s\n", finding.c_str());
  if (!check.sound()) printRepair(mesh, unitOf(o).metres);
}

/// Surfaces of a file that is no patient of ours (yet).
void printSurfaces(const PatientOptions& o) {
  const Organ organ = o.organ.empty() ? Organ::none : organFromName(o.organ.c_str());
  const anatomy::Unit unit = unitOf(o);
  std::vector<CheckedSurface> surfaces;
  for (anatomy::RawMesh& mesh : anatomy::readMeshFile(o.file)) {
    const anatomy::SurfaceCheck check = anatomy::checkSurface(mesh);
    surfaces.push_back({std::move(mesh), check});
    if (organ != Organ::none) checkLength(surfaces.back(), o, organ);
  }
  std::printf("%s, lengths read as %s%s\n", counted(surfaces.size(), "surface").c_str(), unit.words,
              o.unit.empty() ? " (say --unit mm and the like where they are not)" : "");
  for (const CheckedSurface& surface : surfaces) printSurface(surface, o);
}

/// A patient of ours says so in its file; anything else is a set of surfaces.
void info(const PatientOptions& o) {
  if (o.file.empty()) return printPatient(build(o));
  const bool other = anatomy::meshFormat(o.file) != anatomy::MeshFormat::gltf || !o.unit.empty() ||
                     !o.organ.empty();
  if (other || !anatomy::isPatientFile(o.file)) return printSurfaces(o);
  printPatient(anatomy::readPatient(o.file));
}

/// A patient of many files, told file by file.
void import(const ImportCommand& o) {
  const anatomy::ImportMap map = anatomy::readImportMap(o.map, {o.unit, o.axes});
  if (std::filesystem::path(o.out).extension() != ".glb")
    throw UsageError("is \"" + o.out + "\"", "--out", "A patient file ends in .glb");
  anatomy::ImportReport report;
  const anatomy::Patient patient = anatomy::importPatient(
      map, o.folder, {static_cast<std::size_t>(o.triangles), 1e-3 * o.weld_mm}, &report);
  for (const std::string& line : anatomy::words(report)) std::printf("%s\n", line.c_str());
  anatomy::writePatient(patient, o.out);
  std::printf("Written: %s (%s; licence: %s)\n", o.out.c_str(), patient.name.c_str(),
              patient.licence.c_str());
}

void addImport(CLI::App& patient) {
  const auto o = std::make_shared<ImportCommand>();
  CLI::App* command = patient.add_subcommand(
      "import", "A patient from many mesh files, as a map file describes them");
  command->footer(
      "Example:\n  palpa patient import --map assets/patients/bodyparts3d_hra.json DATA --out "
      "p.glb\n"
      "The map (JSON): name, side, unit, axes, licence, source, entries of file, id, organ; more "
      "in anatomy/import/README.md.\n"
      "Axes: where +x, +y, +z of a file point, L/R, A/P, S/I of the patient.");
  command->add_option("folder", o->folder, "Folder of the mesh files")
      ->required()
      ->type_name("DIR");
  command->add_option("--map", o->map, "Map: what each file is (.json)")
      ->required()
      ->type_name("FILE");
  command->add_option("--out", o->out, "File to write (.glb)")->type_name("FILE");
  command->add_option("--unit", o->unit, "Instead of the map's default: " + anatomy::knownUnits())
      ->type_name("UNIT");
  command->add_option("--axes", o->axes, "Instead of the map's default, for example LSA")
      ->type_name("AXES");
  command->add_option("--triangles", o->triangles, "At most so many in the whole patient; 0: all")
      ->check(inRange(0, 20'000'000));
  command->add_option("--weld", o->weld_mm, "Join seams up to this width, mm")
      ->check(inRange(0.0, 1.0, "mm"));
  command->callback([o] { import(*o); });
}

}  // namespace

void addPatient(CLI::App& program) {
  CLI::App* patient = program.add_subcommand("patient", "Build a patient, or see what one holds");
  patient->require_subcommand(1);
  patient->footer(
      "Examples:\n  palpa patient build --bmi 38 --seed 4 --out heavy.glb\n  palpa patient info "
      "heavy.glb\n  palpa patient import --map assets/patients/bodyparts3d_hra.json DATA --out "
      "p.glb");
  const auto o = std::make_shared<PatientOptions>();
  CLI::App* make =
      patient->add_subcommand("build", "Build a patient from the reference figures or a CT volume");
  make->footer(
      "Examples:\n  palpa patient build --sex f --height 1.68 --bmi 24 --side right --seed 3 --out "
      "p.glb\n  palpa patient build --bmi 38 --seed 4 --out heavy.glb      (what is not stated is "
      "drawn at random)\n  palpa patient build --ct chest.mha --previews look --out p.glb\n  palpa "
      "patient build --phantom breast --inclusion-mm 20 --depth-mm 15 --out b.glb");
  const CLI::Option* side =
      make->add_option("--side", o->side,
                       "Side that is punctured (CT: by default that of the contrast)")
          ->check(oneOf({"right", "left"}));
  make->add_option("--sex", o->sex, "f or m (default: drawn)")->check(oneOf({"f", "m"}));
  make->add_option("--height", o->height, "Metres (default: drawn)")->check(aNumber());
  make->add_option("--bmi", o->bmi, "Body mass index, kg/m2 (default: drawn)")->check(aNumber());
  make->add_option("--seed", o->seed,
                   "0: the means of such a person; others are drawn from the spreads")
      ->check(atLeastZero());
  make->add_option("--out", o->out, "File to write (.glb)")->type_name("FILE");
  const auto ct = addCtOptions(*make);
  addPhantomOptions(*make, &o->phantom);
  for (const char* of_person : {"--side", "--sex", "--height", "--bmi", "--seed"})
    make->get_option("--phantom")->excludes(make->get_option(of_person));
  make->get_option("--phantom")->excludes(make->get_option("--ct"));
  make->callback([o, ct, side] {
    WrittenTogether written;
    anatomy::writePatient(
        ct->ct.empty() ? build(*o) : buildFromCt(*ct, side->count() ? o->side : ""), o->out);
    written.keep();
    std::printf("Written: %s\n", o->out.c_str());
  });
  addImport(*patient);
  CLI::App* tells = patient->add_subcommand(
      "info", "Organs, sizes, landmarks, checks; or how good a file of surfaces is");
  tells->footer(
      "Examples:\n  palpa patient info p.glb      (without a file: the reference patient)\n"
      "  palpa patient info clavicle.stl --unit mm --organ clavicle\n"
      "      size, holes, triangles that face different ways; a length that no clavicle has is "
      "refused");
  tells->add_option("file", o->file, "Patient file (.glb), or surfaces (.glb, .obj, .stl, .ply)")
      ->type_name("FILE");
  tells->add_option("--unit", o->unit, "Unit of a file of surfaces: " + anatomy::knownUnits())
      ->type_name("UNIT");
  tells->add_option("--organ", o->organ, "What the surfaces are, to check their size")
      ->type_name("ORGAN")
      ->check(oneOf({"skin", "muscle", "clavicle", "rib", "sternum", "lung", "vein", "artery",
                     "scapula", "cartilage", "airway", "spine", "inclusion"}));
  tells->callback([o] { info(*o); });
}

namespace {

struct RenderOptions {
  std::string patient, out = "patient.png";
  int size = 1500;
  std::string plate;  ///< from where; empty: the page of nine pictures
  std::optional<double> section_mm;
  scene::SkinStyle skin = scene::SkinStyle::hidden;
};

const std::map<std::string, scene::Plane> kPlanes{{"front", scene::Plane::frontal},
                                                  {"side", scene::Plane::sagittal},
                                                  {"above", scene::Plane::axial}};
const std::map<std::string, scene::SkinStyle> kSkins{
    {"hidden", scene::SkinStyle::hidden},
    {"solid", scene::SkinStyle::solid},
    {"translucent", scene::SkinStyle::translucent}};

scene::Image pictureOf(const anatomy::Patient& patient, const RenderOptions& o) {
  const auto context = scene::makeGlContext(scene::Display::offscreen, o.size, o.size, "Palpa");
  if (o.plate.empty()) return scene::contactSheet(*context, patient, o.size, o.size);
  scene::PlateWish wish;
  wish.plane = kPlanes.at(o.plate);
  if (o.section_mm) wish.section = 1e-3 * *o.section_mm;
  wish.skin = o.skin;
  wish.width = o.size;
  wish.height = o.size * 3 / 4;
  return scene::anatomicalPlate(*context, patient, wish);
}

void render(const RenderOptions& o) {
  const anatomy::Patient patient =
      o.patient.empty()
          ? anatomy::buildPatient(anatomy::drawParameters(
                anatomy::readPopulation(station::assetFile("patients/reference.json").string()),
                anatomy::Side::right, 0))
          : anatomy::readPatient(o.patient);
  scene::writePng(pictureOf(patient, o), o.out);
  std::printf("Written: %s (%s)\n", o.out.c_str(), patient.name.c_str());
}

}  // namespace

void addRender(CLI::App& program) {
  const auto o = std::make_shared<RenderOptions>();
  CLI::App* command = program.add_subcommand(
      "render",
      "A patient on one page: solid, translucent, bones and vessels, from three sides; or as a "
      "plate to print, with names, cut where one likes");
  command->footer(
      "Examples:\n  palpa render --patient p.glb --out p.png      (without a file: the reference "
      "patient)\n  palpa render --plate front --out plate.png\n  palpa render --plate above "
      "--section 40 --skin solid --out cut.png");
  command->add_option("--patient", o->patient, "Patient file (.glb)")
      ->type_name("FILE")
      ->check(somethingThere("patients"));
  command->add_option("--out", o->out, "Picture to write (.png)")->type_name("FILE");
  command->add_option("--size", o->size, "Pixels a side; of a plate across")
      ->check(inRange(300, 8192));
  command->add_option("--plate", o->plate, "Instead: a plate to print, seen from there")
      ->check(oneOf(keysOf(kPlanes)))
      ->type_name("above|front|side");
  command
      ->add_option("--section", o->section_mm,
                   "Of a plate: cut so far behind the entry point (negative: before it), mm")
      ->check(inRange(-1000.0, 1000.0, "mm"));
  command
      ->add_option_function<std::string>(
          "--skin", [o](const std::string& text) { o->skin = kSkins.at(text); },
          "Of a plate: skin and muscle (default hidden)")
      ->check(oneOf(keysOf(kSkins)))
      ->type_name("hidden|solid|translucent");
  addGpuArgument(*command);
  command->callback([o, command] {
    for (const char* option : {"--section", "--skin"})
      if (o->plate.empty() && command->count(option) > 0)
        throw UsageError("goes with --plate only", option, "Add --plate front, side or above");
    render(*o);
  });
}

}  // namespace palpa::cli
