#include "anatomy/parametric_patient.h"

#include <algorithm>
#include <cmath>

#include "anatomy/geometry/error.h"
#include "anatomy/parametric/feasibility.h"
#include "anatomy/parametric/frame.h"
#include "anatomy/parametric/pectoralis.h"
#include "anatomy/parametric/thorax.h"

namespace palpa::anatomy {
namespace {

using Colour = std::array<float, 4>;
constexpr Colour kSkinColour{0.87f, 0.70f, 0.60f, 0.45f};
constexpr Colour kBoneColour{0.93f, 0.89f, 0.78f, 1};
constexpr Colour kLungColour{0.86f, 0.62f, 0.66f, 1};
constexpr Colour kVeinColour{0.20f, 0.36f, 0.70f, 1};
constexpr Colour kArteryColour{0.80f, 0.16f, 0.14f, 1};
constexpr Colour kMuscleColour{0.66f, 0.27f, 0.24f, 0.8f};

class Assembly {
 public:
  Assembly(const PatientParameters& parameters, Patient* patient)
      : side_(parameters.side), patient_(patient) {}

  void add(const std::string& id, Organ organ, const TriangleMesh& mesh_B_mm, const Colour& rgba) {
    patient_->organs.push_back({id + "_" + name(side_), organ, fromB(mesh_B_mm, side_), rgba});
  }
  void mark(const char* landmark_name, const Vec3& p_B_mm) {
    patient_->landmarks[landmark_name] = fromB(p_B_mm, side_);
  }

 private:
  Side side_;
  Patient* patient_;
};

// The lung's groove for the vein is deepened until the nearest pleura is as far as asked for.
TriangleMesh lungAtDistance(const Vessels& vessels, const std::vector<Rib>& ribs,
                            const Vec3& target, double radius, double distance) {
  constexpr double kGoodEnough = 0.25;  // mm; the mesh cannot show less
  // The dome stands where it just reaches into the groove.
  double shift_y = target.y() + distance - 29.2;
  double groove = distance;
  TriangleMesh lung;
  for (int i = 0; i < 8; ++i) {
    lung = makeLung(vessels, ribs, shift_y, groove);
    const double found = TriangleTree(lung).closest(target).signed_distance - radius;
    if (std::abs(found - distance) < kGoodEnough) return lung;
    groove += 0.6 * (distance - found);
    if (found > distance) shift_y += 0.7 * (distance - found);  // the dome did not reach so far
  }
  throw Error("the pleura cannot be brought to " + std::to_string(distance) + " mm from the vein",
              "parametric patient", "Choose a pleura distance nearer to its mean");
}

void markLandmarks(const Clavicle& clavicle, const TaughtLine& line, Assembly* assembly) {
  assembly->mark(landmark::kNotch, Vec3::Zero());
  assembly->mark(landmark::kSternalEnd, clavicle.sternal_end);
  assembly->mark(landmark::kSternalEndPosteriorSuperior, clavicle.sternal_end_posterior_superior);
  assembly->mark(landmark::kAcromialEnd, clavicle.acromial_end);
  assembly->mark(landmark::kMedialThird, clavicle.medial_third);
  assembly->mark(landmark::kLateralThird, clavicle.lateral_third);
  assembly->mark(landmark::kEntry, line.entry);
  assembly->mark(landmark::kVeinTarget, line.target);
}

}  // namespace

Patient buildPatient(const PatientParameters& parameters) {
  const Solution solved = solve(parameters);
  const double radius = 500 * parameters.vein_diameter;
  const std::vector<Rib> ribs = makeRibs(radius);

  Patient patient;
  patient.name = parameters.seed == 0 ? "reference" : "seed " + std::to_string(parameters.seed);
  patient.side = parameters.side;
  patient.seed = parameters.seed;
  patient.layers = parameters.layers;
  Assembly assembly(parameters, &patient);
  assembly.add("skin", Organ::skin, solved.skin.mesh(), kSkinColour);
  assembly.add("clavicle", Organ::clavicle, solved.clavicle.mesh, kBoneColour);
  assembly.add("sternum", Organ::sternum, makeSternum(solved.clavicle), kBoneColour);
  for (std::size_t i = 0; i < ribs.size(); ++i)
    assembly.add("rib_" + std::to_string(i + 1), Organ::rib, ribs[i].mesh, kBoneColour);
  assembly.add("lung", Organ::lung,
               lungAtDistance(solved.vessels, ribs, solved.line.target, radius,
                              1e3 * parameters.pleura_distance),
               kLungColour);
  assembly.add("vein", Organ::vein, solved.vessels.veinMesh(), kVeinColour);
  assembly.add("artery", Organ::artery, solved.vessels.arteryMesh(), kArteryColour);
  assembly.add("pectoralis_major", Organ::muscle, makePectoralis(solved.skin, solved.clavicle),
               kMuscleColour);
  markLandmarks(solved.clavicle, solved.line, &assembly);
  // From the field's surface onto the mesh's, some hundredths of a millimetre away.
  Vec3& entry = patient.landmarks[landmark::kEntry];
  entry = TriangleTree(patient.organs.front().mesh).closest(entry).p;
  return patient;
}

}  // namespace palpa::anatomy
