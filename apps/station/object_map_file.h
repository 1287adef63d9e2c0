#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "haptics/modulation/learnt_map.h"

/// The map of a thing that is not the same everywhere, as `palpa calibrate object` left it.
namespace palpa::station {

/// Figures at the nodes of a grid in the plane z = 0 of P, row by row from the lowest y.
struct MappedObject {
  Eigen::Vector2d low = Eigen::Vector2d::Zero(), high = Eigen::Vector2d::Zero();  ///< m
  int columns = 0, rows = 0;
  double depth = 0;  ///< m, of the secant stiffness
  /// N/m, pressed infinitely slowly; standard deviation of its logarithm
  std::vector<double> stiffness, stiffness_sd;
  std::vector<double> friction;  ///< what rubs by what presses
  /// What a press loses while it is held: shares of the slow force, and their times, s
  std::vector<double> relaxation_share, relaxation_time;
  std::string date;
  bool simulated = false;

  Eigen::Vector2d step() const {
    return (high - low).cwiseQuotient(Eigen::Vector2d(columns - 1, rows - 1));
  }
};

/// Throws Error naming the file: of another kind, one that did not pass, of another station than
/// `station`, with figures that cannot be meant, or with more nodes than the loop takes.
MappedObject readMappedObject(const std::filesystem::path& file, const std::string& station);

/// As in the evidence; what `mappedObjectIn` reads again. Throws Error for a text that is damaged.
nlohmann::json jsonOf(const MappedObject& object);
MappedObject mappedObjectIn(const nlohmann::json& json);

/// The same for the loop, by how much each place differs from the one law H of the object:
///     s(p) = S(p) (1 + sum share_i q(T / time_i)) d / H(d - x0, d / T)
///     r(p) = mu(p) / mu
/// S is what an infinitely slow press takes. A hand's press of T = 0.5 s [chosen: a palpation's]
/// to the depth d has lost less: of a force that rises evenly, q(u) = (1 - exp(-u)) / u is left of
/// a share. H is at the same speed. 1 where the law has no such figure.
haptics::LearntMap learntMap(const MappedObject& object, const haptics::StiffnessModulation& law);

}  // namespace palpa::station
