#include "anatomy/parametric/parametric_patient.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "anatomy/base/error.h"
#include "anatomy/parametric/build.h"
#include "anatomy/parametric/feasibility.h"
#include "anatomy/parametric/skin_texture.h"
#include "anatomy/parametric/thorax.h"
#include "anatomy/patient/patient_file.h"
#include "anatomy/shapes/mesh_tools.h"

namespace palpa::anatomy {
namespace {

using Colour = std::array<float, 4>;
constexpr Colour kSkinColour{1, 1, 1, 0.45f};  // the tone comes from the texture
constexpr Colour kBoneColour{0.93f, 0.89f, 0.78f, 1};
constexpr Colour kCartilageColour{0.74f, 0.80f, 0.82f, 1};
constexpr Colour kAirwayColour{0.82f, 0.85f, 0.74f, 1};
constexpr Colour kLungColour{0.86f, 0.62f, 0.66f, 1};
constexpr Colour kVeinColour{0.20f, 0.36f, 0.70f, 1};
constexpr Colour kArteryColour{0.80f, 0.16f, 0.14f, 1};
constexpr Colour kMuscleColour{0.66f, 0.27f, 0.24f, 0.8f};

// Puts organs together: those of the punctured side come first of their kind.
class Assembly {
 public:
  Assembly(const PatientParameters& parameters, Patient* patient)
      : side_(parameters.side), patient_(patient) {}

  void add(const std::string& id, Organ organ, const TriangleMesh& mesh_B_mm, const Colour& rgba) {
    patient_->organs.push_back({id, organ, fromB(mesh_B_mm, side_), rgba});
  }
  void addBoth(const std::string& id, Organ organ, const TriangleMesh& mesh_B_mm,
               const Colour& rgba) {
    add(id + "_" + name(side_), organ, mesh_B_mm, rgba);
    add(otherId(id), organ, mirroredMesh(mesh_B_mm), rgba);
  }
  std::string otherId(const std::string& id) const {
    return id + "_" + name(side_ == Side::right ? Side::left : Side::right);
  }
  std::string sideId(const std::string& id) const { return id + "_" + name(side_); }
  void mark(const char* landmark_name, const Vec3& p_B_mm) {
    patient_->landmarks[landmark_name] = fromB(p_B_mm, side_);
  }

 private:
  Side side_;
  Patient* patient_;
};

void addSkin(const Solution& solved, std::uint64_t seed, Assembly* assembly, Patient* patient) {
  TriangleMesh skin_B_mm = solved.skin.mesh();
  layPicture(&skin_B_mm);
  assembly->add("skin", Organ::skin, skin_B_mm, kSkinColour);
  patient->organs.back().texture = paintSkin(skin_B_mm, solved.build, seed);
}

struct Lungs {
  TriangleMesh near, other;
};

// The lung's groove for the vein is deepened until the nearest pleura is as far as asked for.
Lungs lungsAtDistance(const Solution& s, const std::vector<Rib>& ribs, double radius,
                      double distance) {
  constexpr double kGood = 0.12, kGoodEnough = 0.25;  // mm
  constexpr int kTries = 12;
  const Vec3& target = s.line.target;
  const double reach = radius + distance + 12;
  const Eigen::AlignedBox3d near_target(Vec3(target.array() - reach), Vec3(target.array() + reach));
  struct Try {
    double shift_y, groove, error;
  };
  // The dome stands where it just reaches into the groove.
  Try now{target.y() + distance - 29.2, distance, 0}, best{0, 0, 2 * kGoodEnough};
  for (int i = 0; i < kTries && std::abs(best.error) > kGood; ++i) {
    const TriangleMesh pleura =
        makeLung(s.vessels, ribs, s.build, 1, now.shift_y, now.groove, near_target);
    now.error =
        distance - (pleura.triangles.empty()
                        ? 2 * distance
                        : (TriangleTree(pleura).closest(target).p - target).norm() - radius);
    if (std::abs(now.error) < std::abs(best.error)) best = now;
    const double step =
        i < kTries / 2 ? 0.6 : 0.25;  // what the mesh makes of a small step is no smooth function
    now.groove += step * now.error;
    if (now.error < 0) now.shift_y += 1.2 * step * now.error;  // the dome did not reach so far
  }
  if (std::abs(best.error) > kGoodEnough)
    throw Error("the pleura cannot be brought to " + std::to_string(distance) + " mm from the vein",
                "parametric patient", "Choose a pleura distance nearer to its mean");
  const auto lung = [&](double sign) {
    return makeLung(s.vessels, ribs, s.build, sign, best.shift_y, best.groove);
  };
  return {lung(1), lung(-1)};
}

// Signed distance to the bones of both sides; far away (kFar of the round stand-in) only about.
Field clavicles(const Clavicle& clavicle) {
  constexpr double kFar = 8;
  const auto tree = std::make_shared<TriangleTree>(clavicle.mesh);
  return [tree, tube = clavicle.tube](const Vec3& p) {
    const Vec3 there(std::abs(p.x()), p.y(), p.z());
    const double about = tube(there);
    return about > kFar ? about : tree->closest(there).signed_distance;
  };
}

void markLandmarks(const Solution& solved, Assembly* assembly) {
  const Clavicle& clavicle = solved.clavicle;
  const TaughtLine& line = solved.line;
  assembly->mark(landmark::kNotch, Vec3::Zero());
  assembly->mark(landmark::kSternalEnd, clavicle.sternal_end);
  assembly->mark(landmark::kSternalEndPosteriorSuperior, clavicle.sternal_end_posterior_superior);
  assembly->mark(landmark::kAcromialEnd, clavicle.acromial_end);
  assembly->mark(landmark::kMedialThird, clavicle.medial_third);
  assembly->mark(landmark::kLateralThird, clavicle.lateral_third);
  assembly->mark(landmark::kEntry, line.entry);
  assembly->mark(landmark::kVeinTarget, line.target);
  assembly->mark(landmark::kWindow, solved.window);
  assembly->mark(landmark::kWindowSkin, solved.window_skin);
}

std::string nameOf(const PatientParameters& p) {
  char person[96];
  std::snprintf(person, sizeof person, "%s, %.2f m, BMI %.1f, ",
                p.sex == Sex::female ? "woman" : "man", p.height, p.bmi);
  return person + (p.seed == 0 ? std::string("reference") : "seed " + std::to_string(p.seed));
}

}  // namespace

Patient buildPatient(const PatientParameters& parameters) {
  const Solution solved = solve(parameters);
  const double radius = 500 * parameters.vein_diameter;
  const std::vector<Rib> ribs = makeRibs(solved.build, radius);

  Patient patient;
  patient.name = nameOf(parameters);
  patient.side = parameters.side;
  patient.seed = parameters.seed;
  patient.layers = parameters.layers;
  Assembly assembly(parameters, &patient);
  addSkin(solved, parameters.seed, &assembly, &patient);
  assembly.addBoth("clavicle", Organ::clavicle, solved.clavicle.mesh, kBoneColour);
  assembly.add("sternum", Organ::sternum, makeSternum(solved.clavicle, solved.build), kBoneColour);
  for (std::size_t i = 0; i < ribs.size(); ++i) {
    assembly.addBoth("rib_" + std::to_string(i + 1), Organ::rib, ribs[i].bone, kBoneColour);
    assembly.addBoth("costal_cartilage_" + std::to_string(i + 1), Organ::cartilage,
                     ribs[i].cartilage, kCartilageColour);
  }
  assembly.addBoth("scapula", Organ::scapula, makeScapula(solved.clavicle, solved.build),
                   kBoneColour);
  assembly.add("spine", Organ::spine, makeSpine(solved.build), kBoneColour);
  const Lungs lungs = lungsAtDistance(solved, ribs, radius, 1e3 * parameters.pleura_distance);
  assembly.add(assembly.sideId("lung"), Organ::lung, lungs.near, kLungColour);
  assembly.add(assembly.otherId("lung"), Organ::lung, lungs.other, kLungColour);
  assembly.add("airway", Organ::airway, makeAirway(solved.vessels), kAirwayColour);
  const Field bones = clavicles(solved.clavicle);
  assembly.add("veins", Organ::vein, solved.vessels.veinMesh(bones), kVeinColour);
  assembly.add("arteries", Organ::artery, solved.vessels.arteryMesh(bones, solved.build.floor(9)),
               kArteryColour);
  assembly.addBoth("pectoralis_major", Organ::muscle,
                   makePectoralisMajor(solved.skin, solved.clavicle), kMuscleColour);
  assembly.addBoth("pectoralis_minor", Organ::muscle,
                   makePectoralisMinor(solved.skin, solved.clavicle, solved.build), kMuscleColour);
  assembly.addBoth("subclavius", Organ::muscle, makeSubclavius(solved.skin, solved.clavicle),
                   kMuscleColour);
  markLandmarks(solved, &assembly);
  roundAsInFile(patient);
  // From the field's surface onto the mesh's, some hundredths of a millimetre away.
  Vec3& entry = patient.landmarks[landmark::kEntry];
  entry = TriangleTree(patient.organs.front().mesh).closest(entry).p;
  return patient;
}

}  // namespace palpa::anatomy
