#include "anatomy/volume/ct_patient.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "anatomy/base/error.h"
#include "anatomy/volume/segmentation.h"

namespace palpa::anatomy {
namespace {

using Colour = std::array<float, 4>;
constexpr double kSkinSmoothing = 4e-3, kSkinCell = 4.5e-3, kSkinBeyond = 4e-3;
constexpr double kVeinSleeve = 2.2e-3;  // blooming about dense contrast is no bone

Colour colourOf(Organ organ) {
  switch (organ) {
    case Organ::skin:
      return {0.87f, 0.70f, 0.60f, 0.45f};
    case Organ::lung:
      return {0.86f, 0.62f, 0.66f, 1};
    case Organ::vein:
      return {0.20f, 0.36f, 0.70f, 1};
    case Organ::artery:
      return {0.80f, 0.16f, 0.14f, 1};
    default:
      return {0.93f, 0.89f, 0.78f, 1};
  }
}

class Builder {
 public:
  Builder(const CtOptions& options, const StepProgress& progress)
      : options_(options), progress_(progress) {}

  CtPatient run(const Volume& volume) {
    report("body", 0);
    Levels levels = levelsOf(volume);
    if (options_.bone_level) levels.bone = *options_.bone_level;
    if (options_.dense_level) levels.dense = *options_.dense_level;
    ct_.scan = prepareScan(volume, levels);
    segment();
    mesh();
    report("landmarks", 0.9);
    remarkOnData();
    ct_.patient.side = vein_.side;
    markLandmarks(*(vein_.side == Side::right ? clavicles_.right : clavicles_.left), vein_,
                  options_.seeds, &ct_);
    intoA();
    return std::move(ct_);
  }

 private:
  void report(const char* step, double done) const {
    if (progress_) progress_(step, done);
  }

  void segment() {
    const Scan& scan = ct_.scan;
    report("vein", 0.15);
    std::optional<Vein> vein = findVein(scan, options_.seeds);
    if (!vein || vein->line_S.size() < 4)
      throw Error(
          "no contrast-filled vein was found", "CT volume",
          "Give --seed-point vein_axilla=x,y,z and vein_svc=x,y,z (mm), or lower --vein-level");
    vein_ = std::move(*vein);
    ct_.seeds = vein_.seeds;
    if (options_.side) vein_.side = *options_.side;
    report("clavicles", 0.25);
    taken_ = dilated(scan.grid, vein_.mask, kVeinSleeve);
    clavicles_ = findClavicles(scan, taken_, options_.seeds);
    const std::optional<Clavicle3>& own =
        vein_.side == Side::right ? clavicles_.right : clavicles_.left;
    if (!own)
      throw Error(std::string("no clavicle was found on the ") + name(vein_.side) + " side",
                  "CT volume",
                  std::string("Give --seed-point clavicle_") + name(vein_.side) +
                      "=x,y,z (mm), check --ct-axes, or set --bone-level");
    report("lungs, ribs, sternum", 0.5);
    const double middle = midline();
    ct_.labels.push_back(
        {std::string("vein_") + name(vein_.side), Organ::vein, vein_.mask, false, 1.2e-3, 1.5e-3});
    addClavicle(vein_.side);
    addClavicle(vein_.side == Side::right ? Side::left : Side::right);
    Mask others = taken_;
    for (const LabelledOrgan& organ : ct_.labels)
      for (std::size_t n = 0; n < others.size(); ++n) others[n] |= organ.mask[n];
    others = dilated(scan.grid, others, scan.grid.spacing.minCoeff() * 1.01);
    for (std::size_t n = 0; n < others.size(); ++n) others[n] |= vein_.contrast[n];
    std::vector<LabelledOrgan> lungs = findLungs(scan, middle);
    const Vec3 end = own->axis_S.front();
    std::vector<LabelledOrgan> bones =
        findThoraxBones(scan, lungs, others, middle, end.y(), end.z());
    ownSideFirst(&bones), ownSideFirst(&lungs);
    for (auto* found : {&bones, &lungs})
      ct_.labels.insert(ct_.labels.end(), found->begin(), found->end());
  }

  void ownSideFirst(std::vector<LabelledOrgan>* organs) const {
    const std::string other = vein_.side == Side::right ? "_left" : "_right";
    std::stable_partition(organs->begin(), organs->end(), [&](const LabelledOrgan& organ) {
      return organ.id.find(other) == std::string::npos;
    });
  }

  double midline() {
    Vec3 middle = Vec3::Zero();
    int count = 0;
    for (const auto* clavicle : {&clavicles_.right, &clavicles_.left})
      if (*clavicle) middle += (*clavicle)->axis_S.front(), ++count;
    middle /= count;
    if (count < 2) middle.x() = ct_.scan.midline_x;
    ct_.seeds["midline"] = options_.seeds.count("midline") ? options_.seeds.at("midline") : middle;
    return ct_.seeds["midline"].x();
  }

  void addClavicle(Side side) {
    const std::optional<Clavicle3>& clavicle =
        side == Side::right ? clavicles_.right : clavicles_.left;
    if (!clavicle) {
      ct_.remarks.push_back(std::string("The ") + name(side) +
                            " clavicle was not found: give --seed-point clavicle_" + name(side) +
                            "=x,y,z");
      return;
    }
    char words[120];
    std::snprintf(words, sizeof words, "The %s clavicle is %.0f mm long inside the volume%s",
                  name(side), 1e3 * clavicle->length,
                  clavicle->leaves_volume ? " and leaves it" : "");
    ct_.remarks.push_back(words);
    ct_.seeds[std::string("clavicle_") + name(side)] = clavicle->seed_S;
    ct_.labels.push_back({std::string("clavicle_") + name(side), Organ::clavicle, clavicle->mask,
                          false, 1.2e-3, 1.5e-3});
  }

  void mesh() {
    report("surfaces", 0.7);
    const Scan& scan = ct_.scan;
    const bool guessed = scan.levels.clipped;
    const double over = guessed ? options_.layers.skin + options_.layers.fat : 0;
    ct_.labels.push_back({guessed ? "skin_estimated" : "skin", Organ::skin,
                          skinMask(scan, ct_.labels), guessed, kSkinSmoothing, kSkinCell});
    add(ct_.labels.back(), nullptr, over, kSkinBeyond);
    Values occupied = nothingOccupied(scan);
    for (const LabelledOrgan& organ : ct_.labels)
      if (organ.organ != Organ::skin) add(organ, &occupied, 0, 0);
  }

  void add(const LabelledOrgan& label, Values* occupied, double outward, double beyond) {
    OrganSurface surface{
        label.id, label.organ,
        labelSurface(ct_.scan, label.mask, occupied, label.smoothing, label.cell, outward, beyond),
        colourOf(label.organ)};
    if (!surface.mesh.triangles.empty()) ct_.patient.organs.push_back(std::move(surface));
  }

  void remarkOnData() {
    std::string estimated;
    for (const LabelledOrgan& label : ct_.labels)
      if (label.estimated) estimated += (estimated.empty() ? "" : ", ") + label.id;
    ct_.patient.name = options_.name + (estimated.empty() ? "" : " (estimated: " + estimated + ")");
    if (!estimated.empty())
      ct_.remarks.push_back(
          "Air, lung and fat are lost in this volume (it starts at soft tissue): " + estimated +
          " are estimated from what surrounds them, and so are the layers under the skin");
  }

  void intoA() {
    Patient& patient = ct_.patient;
    patient.layers = options_.layers;
    for (const char* key : {landmark::kNotch, landmark::kEntry, landmark::kVeinTarget})
      ct_.seeds[key] = patient.landmarks.at(key);
    ct_.origin_S = patient.landmarks.at(landmark::kNotch);
    for (OrganSurface& surface : patient.organs)
      for (Vec3& p : surface.mesh.points) p -= ct_.origin_S;
    for (auto& [key, p] : patient.landmarks) p -= ct_.origin_S;
  }

  const CtOptions& options_;
  const StepProgress& progress_;
  CtPatient ct_;
  Vein vein_;
  Clavicles clavicles_;
  Mask taken_;
};

}  // namespace

CtPatient buildCtPatient(const Volume& volume, const CtOptions& options,
                         const StepProgress& progress) {
  return Builder(options, progress).run(volume);
}

}  // namespace palpa::anatomy
