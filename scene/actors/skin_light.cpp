#include "scene/actors/skin_light.h"

#include <vtkActor.h>
#include <vtkShaderProperty.h>

namespace palpa::scene {
namespace {

/// In place of VTK's own highlight; its ambient and diffuse colours stay.
constexpr char kLight[] = R"glsl(
  //VTK::Light::Impl
  {
    const vec3 under = vec3(0.30, 0.12, 0.08);
    const float rough = 0.35, f = 0.028;
    vec3 toEye = cameraParallel == 1 ? vec3(0.0, 0.0, 1.0) : normalize(-vertexVC.xyz);
    vec3 half_way = normalize(toEye - lightDirectionVC0);
    float nl = dot(normalVCVSOutput, -lightDirectionVC0);
    float nv = max(dot(normalVCVSOutput, toEye), 1e-3);
    float nh = max(dot(normalVCVSOutput, half_way), 0.0);
    vec3 matt = max(vec3(0.0), (nl + under) / (1.0 + under));
    nl = max(nl, 0.0);
    float spread = nh * nh * (rough * rough - 1.0) + 1.0;
    float facets = rough * rough / (spread * spread);
    float back = f + (1.0 - f) * pow(1.0 - clamp(dot(toEye, half_way), 0.0, 1.0), 5.0);
    float hidden = 2.0 * mix(2.0 * nl * nv, nl + nv, rough);
    gl_FragData[0].rgb = ambientColor + lightColor0 * (diffuseColor * matt +
                         nl * facets * back / max(hidden, 1e-4));
  }
)glsl";

}  // namespace

void lightAsSkin(vtkActor& actor) {
  actor.GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", false, kLight,
                                                          false);
}

}  // namespace palpa::scene
