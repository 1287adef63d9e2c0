#pragma once

#include <vtkSmartPointer.h>

#include <optional>
#include <vector>

#include "anatomy/patient.h"
#include "scene/scene_state.h"

class vtkActor;
class vtkPolyDataMapper;
class vtkRenderer;

namespace palpa::scene {

/// A plane that cuts a patient: what lies before it, against its normal, is taken away.
struct Section {
  Vec3 p_A = Vec3::Zero(), n_A = Vec3::UnitX();
};

/// A patient's surfaces, whole or as a cut leaves them: closed where they are cut, there paler and
/// with a dark outline; what the skin holds is fat, unless it is an organ's. Flat caps of one plane
/// would fight for each pixel: those of what is further out lie a little deeper.
class CutOrgans {
 public:
  CutOrgans(vtkRenderer& renderer, const anatomy::Patient& patient,
            const std::optional<Section>& section, SkinStyle skin);

  /// Each kind in one colour without light (kindOf its red), what is translucent not at all: so
  /// that the pixels tell what is seen where. And back.
  void paintKinds(bool on);
  static Organ kindOf(std::uint8_t red);

 private:
  struct CutPart {
    Organ organ = Organ::none;
    vtkSmartPointer<vtkActor> actor;
    bool is_outline = false, by_cells = false;
    double opacity = 1;
  };
  void add(vtkRenderer& renderer, const anatomy::OrganSurface& organ,
           const std::optional<Section>& section, SkinStyle skin);

  std::vector<CutPart> parts_;
};

}  // namespace palpa::scene
