#pragma once

#include <string>
#include <vector>

#include "haptics/materials/texture.h"

/// What shakes a tool on a rough surface, from strokes over it at several forces and speeds.
namespace palpa::calibration {

/// At even times: normal force, N; speed along the surface, m/s; what shakes the tool, N: its mass
/// times its acceleration.
struct TextureSample {
  double f_n = 0, speed = 0, shake = 0;
};
/// Samples of one stroke or of many, without a gap.
using TextureStroke = std::vector<TextureSample>;

/// Where models are wanted: N and m/s, each rising; at most kMostTextureForces, kMostTextureSpeeds.
/// The shipped rows [chosen]: what hands do that feel a surface; from one to the next a factor of
/// 1.33 in speed, because ribs move through the spectrum with it, and of 1.85 in force.
struct TextureGrid {
  std::vector<double> forces{0.3, 0.55, 1.0, 1.9};
  std::vector<double> speeds{0.030, 0.040, 0.053, 0.071, 0.095, 0.127, 0.169, 0.225};
};

struct TextureModel {
  haptics::TextureLaw law;      ///< without a bound
  std::vector<double> seconds;  ///< of steady strokes at each node, row of a force by row
  /// The worst node's standard error of its level, dB: what scatters from piece to piece
  double level_sd_dB = 0;
  /// The standard error of a node's spectrum in the lowest third octave, dB, by the least seconds
  double lowest_band_sd_dB = 0;
  std::string advice;  ///< what would tell more; empty: nothing needed
};

/// Strokes are divided into pieces of 0.25 s in which force and speed stay within 15 % (standard
/// deviation over mean); a piece counts for the node of the grid that is nearest in ln F and ln v,
/// within half of the way to the next. The leaky sum y of the shaking (haptics::TextureLaw) is less
/// its mean over each run of pieces; then by Burg's method (1975) over all runs of a node, at each
/// order i
///     k_i = -2 sum f b / sum (f^2 + b^2),   E_i = E_(i-1) (1 - k_i^2)
/// with forward and backward errors f, b. One order for all nodes, the even one that has the least
///     sum over nodes N ln E_p + 2 p             (Akaike 1974)
/// A node lies at the mean logarithms of its row and column. Throws Error, in plain words: for
/// samples that are no numbers or not at 1 kHz, a signal that is cut off or silent, and a node
/// without 4 s of steady strokes.
TextureModel identifyTexture(const std::vector<TextureStroke>& strokes, double dt,
                             const TextureGrid& grid = {});

/// The shaking that the law renders at a stroke's forces and speeds, N.
std::vector<double> renderedTexture(const haptics::TextureLaw& law, const TextureStroke& stroke,
                                    double dt);

}  // namespace palpa::calibration
