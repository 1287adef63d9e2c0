#include <cstdio>
#include <memory>

#include "anatomy/parametric_patient.h"
#include "anatomy/patient_check.h"
#include "anatomy/patient_file.h"
#include "apps/cli/commands.h"
#include "apps/station/assets.h"

namespace palpa::cli {
namespace {

struct PatientOptions {
  std::string file, side = "right", out = "patient.glb";
  std::uint64_t seed = 0;
};

anatomy::Patient build(const PatientOptions& o) {
  return anatomy::buildPatient(anatomy::drawParameters(
      station::assetFile("patients/reference.json").string(),
      o.side == "left" ? anatomy::Side::left : anatomy::Side::right, o.seed));
}

void tell(const anatomy::Patient& patient) {
  std::printf("%s, %s side\n", patient.name.c_str(), anatomy::name(patient.side));
  std::size_t triangles = 0;
  for (const anatomy::OrganSurface& organ : patient.organs) {
    triangles += organ.mesh.triangles.size();
    std::printf("  %-28s %-9s %6zu triangles\n", organ.id.c_str(), name(organ.organ), organ.mesh.triangles.size());
  }
  std::printf("  %zu triangles in all\nLandmarks (mm: left, posterior, superior of the suprasternal notch)\n", triangles);
  for (const auto& [landmark, p] : patient.landmarks)
    std::printf("  %-44s %7.1f %7.1f %7.1f\n", landmark.c_str(), 1e3 * p.x(), 1e3 * p.y(), 1e3 * p.z());
  std::printf("Checks\n");
  for (const auto& finding : anatomy::checkPatient(patient))
    std::printf("  %-4s %-52s %8.2f %s\n", finding.ok ? "ok" : "BAD", finding.name.c_str(), finding.value, finding.unit.c_str());
}

}  // namespace

void addPatient(CLI::App& program) {
  CLI::App* patient = program.add_subcommand("patient", "Build a patient, or see what one holds");
  patient->require_subcommand(1);
  const auto o = std::make_shared<PatientOptions>();
  CLI::App* make = patient->add_subcommand("build", "Build a patient from the reference figures");
  make->footer("Example:\n  palpa patient build --side left --seed 3 --out p.glb");
  make->add_option("--side", o->side, "Side that is punctured")->check(CLI::IsMember({"right", "left"}));
  make->add_option("--seed", o->seed, "0: the reference patient; others are drawn from the spreads")
      ->check(CLI::NonNegativeNumber);
  make->add_option("--out", o->out, "File to write (.glb)")->type_name("FILE");
  make->callback([o] {
    anatomy::writePatient(build(*o), o->out);
    std::printf("Written: %s\n", o->out.c_str());
  });
  CLI::App* info = patient->add_subcommand("info", "Organs, sizes, landmarks, checks");
  info->footer("Example:\n  palpa patient info p.glb      (without a file: the reference patient)");
  info->add_option("file", o->file, "Patient file (.glb)")->type_name("FILE");
  info->callback([o] { tell(o->file.empty() ? build(*o) : anatomy::readPatient(o->file)); });
}

}  // namespace palpa::cli
