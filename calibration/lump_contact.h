#pragma once

#include <array>
#include <string>
#include <vector>

#include "anatomy/geometry/pose.h"
#include "calibration/soft_contact.h"
#include "haptics/materials/dahl.h"

/// What a lump adds to the soft thing it lies in, from touches of a sample that has one (Jeon, Choi
/// & Harders 2015, their 5.2).
namespace palpa::calibration {

/// At even times: tip and reaction on it in one frame, as sensed; the outward normal of the
/// surface; how far the lump has moved (seen by a camera through a clear sample, or by ultrasound).
struct LumpSample {
  Vec3 p = Vec3::Zero(), n = Vec3::UnitZ(), f_r = Vec3::Zero();
  double x = 0, rate = 0;  ///< m, m/s: depth along -n, and its rate
  Vec3 d = Vec3::Zero();   ///< m
};

struct LumpContact {
  haptics::HuntCrossley H_T;  ///< against how much the way between tool and lump is shortened
  std::array<haptics::HuntCrossley, 3> G;  ///< the lump's bed along x, y, z
  double l0 = 0;                           ///< m, from the lump to the surface above it
  double relative_rms = 0;                 ///< of what the lump adds
  std::string advice;
};

/// f_T = f_r + drag - H_NT(x, x') n (10.17, and what a hand rubs that is not quite still); H_T by
/// |f_T| against l = l0 - |p - p_T0 - d| where the tool is above the lump; G_i by f_T,i against
/// |d_i|, i = z above the lump, x and y beside it; where what lies across n tells no law, it is
/// taken from the line between lump and the middle of the tip. `H_NT`, `x0`: the same thing without
/// a lump, and where its contact begins; `friction`: of its surface; none: nothing rubs; `p_T0`:
/// where the lump rests; `tip_radius`: of a round tip, m; `dt` between samples. Throws Error, in
/// plain words.
LumpContact identifyLump(const std::vector<LumpSample>& samples, const SoftContact& without,
                         const haptics::Dahl& friction, const Vec3& p_T0, double tip_radius,
                         double dt);

}  // namespace palpa::calibration
