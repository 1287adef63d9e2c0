#include "anatomy/geometry/local_geometry.h"

#include <cmath>
#include <cstring>

namespace palpa {
namespace {

constexpr int kNewtonSteps = 3;

struct Height {
  double h, ha, hb, haa, hab, hbb;
};

Height polynomial(const double* c, double a, double b) {
  Height z;
  z.h = c[0] + a * (c[1] + a * (c[3] + a * c[6])) + b * (c[2] + b * (c[5] + b * c[9])) +
        a * b * (c[4] + a * c[7] + b * c[8]);
  z.ha = c[1] + a * (2 * c[3] + 3 * a * c[6]) + b * (c[4] + 2 * a * c[7] + b * c[8]);
  z.hb = c[2] + b * (2 * c[5] + 3 * b * c[9]) + a * (c[4] + a * c[7] + 2 * b * c[8]);
  z.haa = 2 * c[3] + 6 * a * c[6] + 2 * b * c[7];
  z.hab = c[4] + 2 * a * c[7] + 2 * b * c[8];
  z.hbb = 2 * c[5] + 2 * a * c[8] + 6 * b * c[9];
  return z;
}

/// Beyond the reach the polynomial is not known: the tangent plane at its rim goes on.
Height height(const SurfacePatch& patch, double a, double b) {
  const double out2 = a * a + b * b;
  if (out2 <= patch.reach * patch.reach) return polynomial(patch.c, a, b);
  const double k = patch.reach / std::sqrt(out2);
  Height z = polynomial(patch.c, k * a, k * b);
  z.h += (1 - k) * (z.ha * a + z.hb * b);
  z.haa = z.hab = z.hbb = 0;
  return z;
}

}  // namespace

PatchContact nearestOn(const SurfacePatch& patch, const Vec3& p) noexcept {
  const Vec3 n = unpack(patch.n), x = unpack(patch.x), y = n.cross(x);
  const Vec3 q = p - unpack(patch.p);
  const double pa = q.dot(x), pb = q.dot(y), pn = q.dot(n);
  double a = pa, b = pb;
  Height z = height(patch, a, b);
  for (int step = 0; step < kNewtonSteps; ++step) {
    const double gap = z.h - pn;
    const double ga = a - pa + gap * z.ha, gb = b - pb + gap * z.hb;
    double haa = 1 + z.ha * z.ha + gap * z.haa, hbb = 1 + z.hb * z.hb + gap * z.hbb;
    double hab = z.ha * z.hb + gap * z.hab;
    double det = haa * hbb - hab * hab;
    if (!(haa > 0.1 && det > 0.1)) {  // near a centre of curvature: without the second derivatives
      haa = 1 + z.ha * z.ha, hbb = 1 + z.hb * z.hb, hab = z.ha * z.hb;
      det = haa * hbb - hab * hab;
    }
    a -= (hbb * ga - hab * gb) / det;
    b -= (haa * gb - hab * ga) / det;
    z = height(patch, a, b);
  }
  PatchContact contact;
  contact.normal = (n - z.ha * x - z.hb * y).normalized();
  contact.foot = unpack(patch.p) + a * x + b * y + z.h * n;
  contact.distance = (p - contact.foot).dot(contact.normal);
  return contact;
}

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
