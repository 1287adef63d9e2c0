#pragma once

#include "haptics/contact/needle_contact.h"

namespace palpa::haptics {

/// A block of tissue, skin at z = 0, needle pushed down along -z: the simplest world with all
/// contacts.
struct NeedleBench {
  NeedleMaterials materials;
  CouplingLimits coupling;
  LocalGeometry geometry;
  NeedleState state;
  Vec3 axis = -Vec3::UnitZ();
  TickCommands commands;
  static constexpr double kDt = 0.001;

  NeedleBench() {
    geometry.number = 1;
    auto& layers = materials.layers;
    layers[static_cast<int>(Tissue::skin)] = {2, 0.3, 20};
    layers[static_cast<int>(Tissue::fat)] = {1, 0.1, 5};
    layers[static_cast<int>(Tissue::muscle)] = {3, 0.3, 10};
    materials.walls[static_cast<int>(Organ::vein)] = {400, 0.4, 0, {}};
    addPlane(0, Tissue::air, Tissue::skin, Organ::skin, false);
    addPlane(0.002, Tissue::skin, Tissue::fat, Organ::none, false);
    addPlane(0.008, Tissue::fat, Tissue::muscle, Organ::none, false);
    addPlane(0.020, Tissue::muscle, Tissue::vein_lumen, Organ::vein, false);
    addPlane(0.029, Tissue::vein_lumen, Tissue::muscle, Organ::vein, true);
  }
  void addPlane(double depth, Tissue from, Tissue to, Organ wall, bool leaving) {
    geometry.boundaries[geometry.boundary_count++] = {{0, 0, -depth}, {0, 0, 1}, from, to,
                                                      wall,           leaving};
  }
  NeedleContact at(const Vec3& tip) {
    return needleContact(materials, coupling, geometry, {tip, axis, tip - 0.11 * axis}, commands,
                         kDt, state);
  }
  NeedleContact atDepth(double depth) { return at({0, 0, -depth}); }
  /// Moves the tip straight from one depth to another at `speed`; returns the last contact.
  NeedleContact move(double from, double to, double speed = 0.01) {
    NeedleContact last;
    const double step = (to > from ? 1 : -1) * speed * kDt;
    for (double d = from; step > 0 ? d <= to : d >= to; d += step) last = atDepth(d);
    return last;
  }
  void settle(double depth, int ticks = 200) {
    for (int i = 0; i < ticks; ++i) atDepth(depth);
  }
};

}  // namespace palpa::haptics
