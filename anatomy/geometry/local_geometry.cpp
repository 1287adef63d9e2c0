#include "anatomy/geometry/local_geometry.h"

#include <cstring>

namespace palpa {
namespace {
constexpr const char* kOrgans[kOrganCount] = {
    "none",   "skin",   "muscle",  "clavicle",  "rib",    "sternum", "lung",     "vein",
    "artery", "fascia", "scapula", "cartilage", "airway", "spine",   "inclusion"};
constexpr const char* kTissues[kTissueCount] = {
    "air", "skin", "fat", "muscle", "connective", "vein lumen", "artery lumen", "lung", "bone"};
}  // namespace

const char* name(Organ organ) { return kOrgans[static_cast<int>(organ)]; }
const char* name(Tissue tissue) { return kTissues[static_cast<int>(tissue)]; }

Organ organFromName(const char* text) {
  for (int i = 0; i < kOrganCount; ++i)
    if (std::strcmp(text, kOrgans[i]) == 0) return static_cast<Organ>(i);
  return Organ::none;
}

}  // namespace palpa
