#pragma once

#include <vtkNew.h>

#include <memory>
#include <optional>
#include <vector>

#include "anatomy/patient.h"
#include "anatomy/query/triangle_tree.h"
#include "scene/actors/lines.h"
#include "scene/scene_state.h"

class vtkActor;
class vtkPolyData;
class vtkRenderer;

namespace palpa::scene {

/// Where light comes from, in A: straight above a patient who lies on the back, so that a tip's
/// shadow lies straight below it whatever the skin's slope.
inline const Vec3 kTowardLight_A(0, -1, 0);

/// A cross-section of a tool: m behind its tip, and how thick it is there.
struct ToolSection {
  double behind = 0, radius = 0;
};
/// From the tip on.
std::vector<ToolSection> sectionsOf(Tool tool);

/// The shadow of one section on the skin.
struct ShadowPlace {
  Vec3 p_A = Vec3::Zero(), n_A = Vec3::Zero();
  double half_width = 0;  ///< m, where nothing is left of it
  double dark = 0;        ///< 0 to 1, in its middle
};
/// None for what is inside, and where there is no skin below.
std::vector<std::optional<ShadowPlace>> shadowOf(Tool tool, const Pose& X_AT,
                                                 const anatomy::TriangleTree& skin);

/// Where a needle whose tip is inside went through the skin, and the outward normal there.
struct EntryPlace {
  Vec3 p_A, n_A;
};
std::optional<EntryPlace> entryOf(const Pose& X_AT, const anatomy::TriangleTree& skin);

/// What tools cast on the skin, and a ring where a needle went in. Both say in one picture how far
/// off the skin a tip is, or how far behind it: where tip and shadow meet, it touches (the eye
/// takes height from the gap: Kersten, Mamassian and Knill 1997). Light is that of a broad lamp:
/// the farther the tool, the wider and paler.
class ToolShadows {
 public:
  /// A patient without skin has no shadows.
  ToolShadows(vtkRenderer& on_skin, const anatomy::Patient& patient);
  ~ToolShadows();

  /// From where it is seen, in A, and how wide a shadow is at least on the screen, to its distance
  /// (skin that is seen at a grazing angle would leave nothing of it).
  struct Seen {
    Vec3 eye_A = Vec3::Zero();
    double least = 0;
  };
  void update(const SceneState& state, bool visible, const Seen& seen);
  bool any() const;
  /// Of the needle, as of the last update
  std::optional<Vec3> entry_A() const { return entry_A_; }

 private:
  class Ribbon;
  std::unique_ptr<anatomy::TriangleTree> skin_;
  std::vector<std::unique_ptr<Ribbon>> ribbons_;
  EdgedLines ring_;
  std::optional<Vec3> entry_A_;
};

}  // namespace palpa::scene
