#include "apps/cli/phantom_options.h"

#include "anatomy/geometry/error.h"

namespace palpa::cli {

void addPhantomOptions(CLI::App& command, PhantomOptions* options) {
  CLI::Option* phantom = command
                             .add_option("--phantom", options->kind,
                                         "Instead of a person, to be palpated: breast or abdomen")
                             ->check(CLI::IsMember({"breast", "abdomen"}));
  command
      .add_option(
          "--inclusion-mm", options->inclusion_mm,
          "Something hard in it: diameter; abdomen: thickness of a liver's edge (default: none)")
      ->check(CLI::Range(2.0, 200.0))
      ->needs(phantom);
  command.add_option("--depth-mm", options->depth_mm, "Silicone over it")
      ->check(CLI::Range(1.0, 100.0))
      ->needs(phantom);
  command.add_option("--left-mm", options->left_mm, "Breast: so far to the left of the middle")
      ->needs(phantom);
  command.add_option("--up-mm", options->up_mm, "Breast: so far above the middle")->needs(phantom);
}

anatomy::Patient buildPhantom(const PhantomOptions& o) {
  anatomy::PhantomSpec spec;
  spec.kind = o.kind == "breast" ? anatomy::PhantomKind::breast : anatomy::PhantomKind::abdomen;
  if (spec.kind == anatomy::PhantomKind::abdomen && (o.left_mm != 0 || o.up_mm != 0))
    throw UsageError("are for the breast", "--left-mm and --up-mm",
                     "The liver's edge has its place");
  if (o.inclusion_mm > 0)
    spec.inclusion = anatomy::PhantomInclusion{1e-3 * o.inclusion_mm, 1e-3 * o.depth_mm,
                                               1e-3 * o.left_mm, 1e-3 * o.up_mm};
  return anatomy::buildPhantom(spec);
}

}  // namespace palpa::cli
