#pragma once

class vtkActor;

namespace palpa::scene {

/// LIGHT ON SKIN, and on silicone, which bends it as much. With N the normal, L and V to light and
/// eye, H half way between, and the light's white so bright that a white matt surface facing it is
/// 1:
///
///     colour  = ambient + diffuse max(0, (N.L + w) / (1 + w)) + pi N.L D F G
///     D       = a^2 / (pi ((N.H)^2 (a^2 - 1) + 1)^2)         facets of a rough surface
///     F       = f + (1 - f) (1 - V.H)^5                      what they throw back
///     G       = 1 / (2 ((1 - a) 2 N.L N.V + a (N.L + N.V)))   they hide each other
///
/// w, by colour, lets light that has gone under the skin come out beyond the shadow's edge, red
/// farthest. D: Walter et al., EGSR 2007; F: Schlick 1994; G: Hammon, GDC 2017; f = 0.028 of skin
/// (d'Eon and Luebke, GPU Gems 3, ch. 14), 0.029 of silicone, which bends light by 1.41; w: Green,
/// GPU Gems, ch. 16. The actor needs normals, in a scene of one light.
void lightAsSkin(vtkActor& actor);

}  // namespace palpa::scene
