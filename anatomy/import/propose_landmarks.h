#pragma once

#include <string>
#include <vector>

#include "anatomy/patient.h"

namespace palpa::anatomy {

/// Adds the landmarks that the meshes show and the patient lacks; whose origin may lie anywhere,
/// axes as A. Of the punctured side's clavicle: its long axis is the first principal axis of its
/// surface; the ends are the middles of its sections 2 mm inside its extremes, the sternal one
/// nearer to the midplane; the thirds are the middles of its sections at a third and two thirds of
/// the way. The notch is the highest point of the sternum in the midplane where that is near the
/// sternal ends, else midway between the sternal ends of both clavicles. The midplane is that of
/// the sternum, else of the two clavicles. Returns sentences: what was proposed how, and what could
/// not be.
std::vector<std::string> proposeLandmarks(Patient* patient);

/// The middle of a surface's section by a plane: the section's lines, each weighted by its length.
/// NaN where the plane misses the surface.
Vec3 middleOfSection(const TriangleMesh& mesh, const Vec3& p, const Vec3& n);

}  // namespace palpa::anatomy
