#pragma once

#include <optional>
#include <string>

#include "anatomy/geometry/top_shape.h"
#include "anatomy/patient.h"

/// The part of a body that a block of silicone stands for (phantoms.h), to be seen in the block's
/// place; nobody feels it and nothing is judged by it. Frame P of the block, given in A. Metres.
namespace palpa::anatomy {

enum class BodyPart { breast, abdomen, prostate, neck };

/// "breast", "abdomen", "prostate", "neck"; nothing for any other word.
std::optional<BodyPart> bodyPartNamed(const std::string& word);

/// A sheet over the block and the table about it: within `half` of the middle it is the block's
/// top, so that what is seen is where it is felt; from there it runs over 40 mm into a form of the
/// usual size [chosen] and out on the table, `high` below the origin. With a picture.
///   breast     a mound of 150 mm on the chest's wall; areola
///   abdomen    the right upper quadrant: falls to the flanks, rises to the costal margin; navel
///   prostate   the gland through the wall of the rectum: 50 x 40 mm, two lobes, a furrow's shade
///   neck       a vault between jaw and breastbone
OrganSurface bodyPart(BodyPart part, const TopShape& top, const Eigen::Vector2d& half, double high);

}  // namespace palpa::anatomy
