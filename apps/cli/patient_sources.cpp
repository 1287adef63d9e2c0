#include "apps/cli/patient_sources.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "anatomy/patient/gltf.h"
#include "anatomy/patient/patient_check.h"
#include "anatomy/volume/ct_patient.h"
#include "anatomy/volume/scan.h"
#include "anatomy/volume/seed_file.h"
#include "anatomy/volume/volume.h"
#include "apps/cli/commands.h"
#include "apps/cli/values.h"
#include "apps/os/file_access.h"
#include "apps/station/assets.h"
#include "apps/twin/phantom/layered_phantom.h"
#include "apps/twin/phantom/opposed_phantom.h"
#include "apps/twin/phantom/phantom_file.h"

namespace palpa::cli {
namespace {

void writePicture(const anatomy::RgbPicture& picture, const std::filesystem::path& file) {
  const std::vector<unsigned char> png = anatomy::pngOf(picture, file.string());
  writeWhole(file, {reinterpret_cast<const char*>(png.data()), png.size()});
}

/// One picture a step: what was found, over the brightest of the scan.
void writePreviews(const anatomy::CtPatient& ct, const std::filesystem::path& folder) {
  if (const std::error_code problem = os::makeFolders(folder))
    failFile("cannot be made", folder, problem);
  using Labels = std::vector<const anatomy::LabelledOrgan*>;
  const auto those = [&](std::initializer_list<Organ> organs) {
    Labels labels;
    for (const anatomy::LabelledOrgan& label : ct.labels)
      if (std::find(organs.begin(), organs.end(), label.organ) != organs.end())
        labels.push_back(&label);
    return labels;
  };
  const std::pair<const char*, Labels> steps[] = {
      {"1-seeds", {}},
      {"2-vein", those({Organ::vein})},
      {"3-clavicles", those({Organ::clavicle})},
      {"4-thorax", those({Organ::sternum, Organ::rib})},
      {"5-envelope", those({Organ::skin, Organ::lung})},
      {"6-all", those({Organ::vein, Organ::clavicle, Organ::sternum, Organ::rib})}};
  for (const auto& [name, labels] : steps)
    writePicture(anatomy::projections(ct.scan, labels, ct.seeds),
                 folder / (std::string(name) + ".png"));
  std::printf("Previews: %s (red crosses: the points below)\n", folder.string().c_str());
}

void printStep(const std::string& step, double done) {
  const bool terminal = os::errorsGoToTerminal();
  std::fprintf(stderr, terminal ? "\r%3.0f %%  %s \033[K" : "%3.0f %%  %s\n", 100 * done,
               step.c_str());
  std::fflush(stderr);
}

void printResult(const anatomy::CtPatient& ct) {
  if (os::errorsGoToTerminal()) std::fputs("\r\033[K", stderr);
  for (const std::string& words : ct.remarks) std::printf("%s.\n", words.c_str());
  std::printf("Points (mm in the volume's frame); change one and run again:\n");
  for (const auto& [name, p] : ct.seeds)
    std::printf("  %s\n", anatomy::seedOption(name, p).c_str());
  for (const anatomy::PatientFinding& finding : anatomy::checkPatient(ct.patient))
    if (!finding.ok)
      std::printf("Not as it is taught: %s is %.1f %s, wanted %s.\n", finding.name.c_str(),
                  finding.value, finding.unit.c_str(), finding.wanted.c_str());
}

anatomy::Seeds seedsFrom(const CtArguments& a) {
  anatomy::Seeds seeds;
  if (!a.seeds.empty() && std::filesystem::exists(a.seeds)) seeds = anatomy::readSeeds(a.seeds);
  for (const std::string& point : a.points) anatomy::addSeed(point, &seeds);
  return seeds;
}

}  // namespace

std::shared_ptr<CtArguments> addCtOptions(CLI::App& command) {
  auto a = std::make_shared<CtArguments>();
  CLI::Option* ct = command
                        .add_option("--ct", a->ct,
                                    "Build from a contrast CT: .mha, .mhd, .nii, .nii.gz, or a "
                                    "folder with a DICOM series")
                        ->type_name("FILE|FOLDER");
  const auto only = [&](CLI::Option* option) { return option->needs(ct); };
  only(command.add_option(
           "--ct-axes", a->axes,
           "Where columns, rows, slices point, when the header is wrong: three of L/R, "
           "A/P, S/I, e.g. LAI"))
      ->type_name("AXES");
  only(command.add_flag("--ct-mirrored", a->mirrored,
                        "Allow --ct-axes that exchange left and right"));
  only(command.add_option("--ct-series", a->series,
                          "Which DICOM series of the folder: number or UID"))
      ->type_name("N|UID");
  only(command.add_option("--seeds", a->seeds,
                          "File of points to start from; written with what was used"))
      ->type_name("FILE");
  only(command.add_option("--seed-point", a->points,
                          "Move one point: name=x,y,z (mm); may be repeated"))
      ->type_name("NAME=X,Y,Z");
  only(command.add_option("--previews", a->previews, "Folder for pictures of each step"))
      ->type_name("DIR");
  a->bone_given =
      only(command
               .add_option("--bone-level", a->bone,
                           "Value at which bone begins (Hounsfield, or the volume's own)")
               ->check(aNumber()));
  a->dense_given = only(
      command
          .add_option("--vein-level", a->dense, "Value at which the contrast-filled vein begins")
          ->check(aNumber()));
  return a;
}

anatomy::Patient buildFromCt(const CtArguments& a, const std::string& side) {
  printStep("reading", 0);
  anatomy::Volume volume = anatomy::readVolume(a.ct, a.series);
  if (!a.axes.empty()) anatomy::overrideAxes(a.axes, a.mirrored, &volume);
  anatomy::CtOptions options;
  options.name = "CT " + std::filesystem::path(a.ct).stem().string();
  options.seeds = seedsFrom(a);
  if (!side.empty()) options.side = side == "left" ? anatomy::Side::left : anatomy::Side::right;
  if (a.bone_given->count()) options.bone_level = a.bone;
  if (a.dense_given->count()) options.dense_level = a.dense;
  const std::string flip = anatomy::probableFlip(volume, anatomy::levelsOf(volume));
  if (!flip.empty()) std::fprintf(stderr, "%s.\n", flip.c_str());
  anatomy::CtPatient ct = anatomy::buildCtPatient(volume, options, printStep);
  if (!a.previews.empty()) writePreviews(ct, a.previews);
  printResult(ct);
  if (!a.seeds.empty()) {
    anatomy::writeSeeds(ct.seeds, a.seeds);
    std::printf("Written: %s\n", a.seeds.c_str());
  }
  return std::move(ct.patient);
}

void addPhantomOptions(CLI::App& command, PhantomOptions* options) {
  CLI::Option* phantom =
      command
          .add_option("--phantom", options->kind,
                      "A phantom to palpate, instead of a person: breast or abdomen")
          ->check(oneOf({"breast", "abdomen"}));
  command
      .add_option(
          "--inclusion-mm", options->inclusion_mm,
          "Diameter of something hard in it; abdomen: thickness of a liver's edge (default: none)")
      ->check(inRange(2.0, 200.0, "mm"))
      ->needs(phantom);
  command.add_option("--depth-mm", options->depth_mm, "Silicone over it")
      ->check(inRange(1.0, 100.0, "mm"))
      ->needs(phantom);
  command
      .add_option("--left-mm", options->left_mm,
                  "Breast: how far it lies to the left of the middle")
      ->check(aNumber())
      ->needs(phantom);
  command.add_option("--up-mm", options->up_mm, "Breast: how far it lies above the middle")
      ->check(aNumber())
      ->needs(phantom);
}

anatomy::Patient buildPhantom(const PhantomOptions& o) {
  anatomy::PhantomSpec spec;
  spec.kind = o.kind == "breast" ? anatomy::PhantomKind::breast : anatomy::PhantomKind::abdomen;
  if (spec.kind == anatomy::PhantomKind::abdomen && (o.left_mm != 0 || o.up_mm != 0))
    throw UsageError("are for the breast", "--left-mm and --up-mm",
                     "The liver's edge has a fixed place");
  if (o.inclusion_mm > 0)
    spec.inclusion = anatomy::PhantomInclusion{1e-3 * o.inclusion_mm, 1e-3 * o.depth_mm,
                                               1e-3 * o.left_mm, 1e-3 * o.up_mm};
  return anatomy::buildPhantom(spec);
}

namespace {

struct SolveOptions {
  std::string file, out;
};

void solve(const SolveOptions& o) {
  const std::filesystem::path file =
      o.file.empty() ? station::assetFile("phantoms/mockups.json") : std::filesystem::path(o.file);
  const std::filesystem::path out =
      o.out.empty() ? std::filesystem::path(file).replace_extension(".tables.json")
                    : std::filesystem::path(o.out);
  const bool terminal = os::errorsGoToTerminal();
  const auto progress = [&](const std::string& name, int done, int of) {
    if (terminal || done == of)
      std::fprintf(stderr, "%s%s: %d of %d%s", terminal ? "\r" : "", name.c_str(), done, of,
                   done == of ? "\n" : "");
  };
  if (twin::isLayered(file))
    twin::solveLayered(file, out, progress);
  else if (twin::isOpposed(file))
    twin::solveOpposed(file, out, progress);
  else
    twin::solvePhantoms(file, out, progress);
  std::printf("Written: %s\n", out.c_str());
}

}  // namespace

void addPhantom(CLI::App& program) {
  CLI::App* phantom = program.add_subcommand("phantom", "Simulated silicone phantoms");
  phantom->require_subcommand(1);
  phantom->footer("Example:\n  palpa phantom solve      the shipped mock-ups again");
  CLI::App* command = phantom->add_subcommand("solve",
                                              "The force that it takes to press the phantoms of a "
                                              "file, by finite elements (a few minutes each)");
  command->footer(
      "Examples:\n  palpa phantom solve                          the shipped mock-ups again\n  "
      "palpa phantom solve --file mine.json --out mine.tables.json\n"
      "  palpa phantom solve --file assets/phantoms/layered.json\n      blocks with layers, cores "
      "and ribs: an hour\n"
      "  palpa phantom solve --file assets/phantoms/opposed.json\n"
      "      slabs that are pinched from both sides");
  const auto o = std::make_shared<SolveOptions>();
  command->add_option("--file", o->file, "Phantoms (default: assets/phantoms/mockups.json)")
      ->type_name("FILE");
  command->add_option("--out", o->out, "Tables to write (default: beside the file, .tables.json)")
      ->type_name("FILE");
  command->callback([o] { solve(*o); });
}

}  // namespace palpa::cli
