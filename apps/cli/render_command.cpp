#include <cstdio>
#include <memory>

#include "anatomy/parametric_patient.h"
#include "anatomy/patient_file.h"
#include "apps/cli/commands.h"
#include "apps/station/assets.h"
#include "scene/contact_sheet.h"
#include "scene/scene_view.h"

namespace palpa::cli {
namespace {

struct RenderOptions {
  std::string patient, out = "patient.png";
  int size = 1500;
};

void render(const RenderOptions& o) {
  const anatomy::Patient patient =
      o.patient.empty()
          ? anatomy::buildPatient(anatomy::drawParameters(
                anatomy::readPopulation(station::assetFile("patients/reference.json").string()),
                anatomy::Side::right, 0))
          : anatomy::readPatient(o.patient);
  const auto context = scene::makeGlContext(scene::Display::offscreen, o.size, o.size, "Palpa");
  scene::writePng(scene::contactSheet(*context, patient, o.size, o.size), o.out);
  std::printf("Written: %s (%s)\n", o.out.c_str(), patient.name.c_str());
}

}  // namespace

void addRender(CLI::App& program) {
  const auto o = std::make_shared<RenderOptions>();
  CLI::App* command = program.add_subcommand(
      "render", "A patient on one page: solid, translucent, bones and vessels, from three sides");
  command->footer(
      "Example:\n  palpa render --patient p.glb --out p.png      (without a file: the reference "
      "patient)");
  command->add_option("--patient", o->patient, "Patient file (.glb)")->type_name("FILE");
  command->add_option("--out", o->out, "Picture to write (.png)")->type_name("FILE");
  command->add_option("--size", o->size, "Pixels a side")->check(CLI::Range(300, 8192));
  command->callback([o] { render(*o); });
}

}  // namespace palpa::cli
