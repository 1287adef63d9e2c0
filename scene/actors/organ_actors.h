#pragma once

#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "anatomy/patient.h"
#include "anatomy/query/skin_dimple.h"
#include "scene/actors/glass.h"
#include "scene/palette.h"
#include "scene/scene_state.h"

class vtkActor;
class vtkRenderer;

namespace palpa::scene {

/// With normals and texture coordinates where the mesh has them.
vtkSmartPointer<vtkPolyData> polyDataOf(const anatomy::TriangleMesh& mesh);

/// The skin that the large view shows; null: it has none.
const anatomy::OrganSurface* seenSkin(const anatomy::Patient& patient);

/// Its own, or where its file gives none (plain white) that of its kind; its picture apart.
Rgb plainColourOf(const anatomy::OrganSurface& organ);

/// Lies over the organs and hides them: skin, muscle.
bool coversOrgans(Organ organ);

/// The patient's surfaces as actors: organs opaque, and what covers them (skin, muscle) in the
/// chosen style. A surface with a picture shows that, multiplied by its colour. What is translucent
/// goes into `glass`, where there is one; without, VTK's order-independent blending draws it, which
/// is right for a single layer. With `glass` a patient is seen as what he stands for
/// (`Patient::seen_as`).
class OrganActors {
 public:
  OrganActors(vtkRenderer& renderer, const anatomy::Patient& patient, Glass* glass = nullptr);
  ~OrganActors();

  void setStyle(SkinStyle style);
  void setVisible(bool visible);
  void setInside(bool shown);  ///< all but the skin
  /// Of a block of one skin with nothing in it: where that is translucent one looks into silicone,
  /// at its far walls, not through it at what is behind.
  void setWalls(bool shown);
  /// Where the body is that was made in A: a thing that is held moves. Only what is not translucent
  void setPose(const Pose& X_AB);
  /// The first skin's points as they are drawn, of `mesh`; null without one
  vtkPolyData* skin() const { return skin_; }

 private:
  struct OrganPart {
    vtkSmartPointer<vtkActor> actor;
    vtkSmartPointer<vtkPolyData> surface;
    Organ organ = Organ::none;
    bool in_glass = false;
  };
  void add(const anatomy::OrganSurface& organ);
  void apply();
  void moveTo(bool glass, OrganPart& part);

  vtkRenderer& renderer_;
  Glass* glass_;
  std::vector<OrganPart> parts_;
  vtkSmartPointer<vtkPolyData> skin_;
  vtkSmartPointer<vtkActor> inner_side_;  // null: there are organs to be seen
  SkinStyle style_ = SkinStyle::translucent;
  bool visible_ = true, inside_ = true, walls_ = false, moved_ = false, seen_as_ = false;
  vtkNew<vtkMatrix4x4> X_AB_;
};

}  // namespace palpa::scene

class vtkActor;

namespace palpa::scene {

/// Where the skin is cut by the plane through `p_A` with normal `n_A`, as a line: it shows the
/// depth in a fixed view without covering the organs. Null when the patient has no skin there.
vtkSmartPointer<vtkActor> skinSection(const anatomy::Patient& patient, const Vec3& p_A,
                                      const Vec3& n_A);

}  // namespace palpa::scene

class vtkPolyData;

namespace palpa::scene {

/// Moves the points and normals of a drawn skin in place, and puts them back bit for bit when the
/// push ends: what is not under a push has never been touched.
class DeflectedSkin {
 public:
  /// `drawn` shows `mesh` (polyDataOf) and has to outlive this.
  DeflectedSkin(const anatomy::TriangleMesh& mesh, vtkPolyData& drawn);

  void update(const std::optional<anatomy::SkinPush>& push);

 private:
  struct Before {
    std::uint32_t index;
    std::array<float, 3> p, n;
  };
  void restore();

  anatomy::SkinDimple dimple_;
  vtkPolyData& drawn_;
  float* points_;
  float* normals_;  // null: drawn without
  std::vector<Before> before_;
};

}  // namespace palpa::scene
