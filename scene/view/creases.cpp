#include "scene/view/creases.h"

#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkRenderer.h>
#include <vtkShaderProgram.h>

namespace palpa::scene {
namespace {

constexpr float kRadius = 0.012F;  // m: between ribs, under the clavicle, at a tool on the skin

constexpr const char* kDepths = R"(//VTK::System::Dec
in vec2 texCoord;
//VTK::Output::Dec
uniform sampler2D depths;
uniform mat4 to_view;  // from clip space
float depthAt(vec2 at) { return textureLod(depths, at, 0.0).r; }
vec3 placeAt(vec2 at) {
  vec4 p = to_view * vec4(2.0 * at - 1.0, 2.0 * depthAt(at) - 1.0, 1.0);
  return p.xyz / p.w;
}
)";

/// Places on a spiral, turned from pixel to pixel in a pattern of 4 x 4.
constexpr const char* kObscure = R"(
uniform vec2 texel, reach;  // reach: of a metre at a metre, in shares of the picture
uniform float radius;
const int kPlaces = 12;

vec3 nearer(vec3 one, vec3 other) { return abs(one.z) < abs(other.z) ? one : other; }

void main() {
  if (depthAt(texCoord) >= 1.0) {
    gl_FragData[0] = vec4(1.0);
    return;
  }
  vec2 x = vec2(texel.x, 0.0), y = vec2(0.0, texel.y);
  vec3 p = placeAt(texCoord);
  vec3 right = nearer(placeAt(texCoord + x) - p, p - placeAt(texCoord - x));
  vec3 up = nearer(placeAt(texCoord + y) - p, p - placeAt(texCoord - y));
  vec3 normal = normalize(cross(right, up));
  ivec2 pixel = ivec2(gl_FragCoord.xy) & 3;
  float turn = float((pixel.x * 4 + (pixel.y ^ pixel.x)) & 15) * 0.3926991;
  float far = -p.z, square = radius * radius, sum = 0.0;
  for (int i = 0; i < kPlaces; ++i) {
    float share = (float(i) + 0.5) / float(kPlaces), angle = 2.3999632 * float(i) + turn;
    vec2 at = texCoord + reach * (radius * share / far) * vec2(cos(angle), sin(angle));
    at = (floor(clamp(at, vec2(0.0), vec2(0.9999)) / texel) + 0.5) * texel;  // where a depth is
    vec3 v = placeAt(at) - p;
    float vv = dot(v, v), within = max(0.0, square - vv);
    sum += within * within * within * max(0.0, dot(v, normal) - 1e-4 * far) / (vv + 1e-7);
  }
  float whole = float(kPlaces) * square * square * radius;
  gl_FragData[0] = vec4(max(0.0, 1.0 - 5.0 * sum / whole));
}
)";

constexpr const char* kDarken = R"(
uniform sampler2D drawn, lit;
uniform vec2 texel;
uniform float radius;

void main() {
  vec4 own = textureLod(drawn, texCoord, 0.0);
  gl_FragData[0] = own;
  if (depthAt(texCoord) >= 1.0) return;
  float here = placeAt(texCoord).z, sum = 0.0, weights = 0.0;
  for (int row = -2; row < 2; ++row)
    for (int column = -2; column < 2; ++column) {
      vec2 at = texCoord + vec2(column, row) * texel;
      float weight = max(1e-4, 1.0 - abs(placeAt(at).z - here) / radius);
      sum += weight * textureLod(lit, at, 0.0).r;
      weights += weight;
    }
  gl_FragData[0] = vec4(own.rgb * sum / weights, own.a);
}
)";

}  // namespace

void Creases::prepare(vtkOpenGLRenderWindow& window, const FlatPlace& place) {
  if (!obscure_) {
    obscure_ = flatQuad(window, {kDepths, kObscure});
    darken_ = flatQuad(window, {kDepths, kDarken});
    for (vtkTextureObject* texture : {depths_.Get(), lit_.Get(), shaded_.Get()})
      keepInside(*texture, window, vtkTextureObject::ClampToEdge);
    for (vtkTextureObject* texture : {depths_.Get(), lit_.Get()}) {
      texture->SetMinificationFilter(vtkTextureObject::Nearest);
      texture->SetMagnificationFilter(vtkTextureObject::Nearest);
    }
    aside_->SetContext(&window);
  }
  fit(*lit_, place.width, place.height);
  fit(*shaded_, place.width, place.height);
  const auto wide = static_cast<unsigned int>(place.width),
             high = static_cast<unsigned int>(place.height);
  if (depths_->GetHandle() != 0 && depths_->GetWidth() == wide && depths_->GetHeight() == high)
    return;
  depths_->ReleaseGraphicsResources(&window);
  depths_->AllocateDepth(wide, high, vtkTextureObject::Fixed24);
}

vtkTextureObject& Creases::shade(vtkTextureObject& drawn, const FlatPlace& place,
                                 vtkRenderer& renderer) {
  auto& window = *static_cast<vtkOpenGLRenderWindow*>(renderer.GetRenderWindow());
  prepare(window, place);
  depths_->CopyFromFrameBuffer(place.left, place.bottom, 0, 0, place.width, place.height);
  vtkMatrix4x4* to_clip = renderer.GetActiveCamera()->GetProjectionTransformMatrix(
      renderer.GetTiledAspectRatio(), -1, 1);
  vtkNew<vtkMatrix4x4> to_view;
  vtkMatrix4x4::Invert(to_clip, to_view);
  to_view->Transpose();  // as OpenGL keeps it
  const float texel[] = {1.0F / static_cast<float>(place.width),
                         1.0F / static_cast<float>(place.height)};
  const float reach[] = {0.5F * static_cast<float>(to_clip->GetElement(0, 0)),
                         0.5F * static_cast<float>(to_clip->GetElement(1, 1))};
  depths_->Activate();
  const auto begin = [&](vtkOpenGLQuadHelper& quad) -> vtkShaderProgram& {
    window.GetShaderCache()->ReadyShaderProgram(quad.Program);
    quad.Program->SetUniformi("depths", depths_->GetTextureUnit());
    quad.Program->SetUniformMatrix("to_view", to_view);
    quad.Program->SetUniform2f("texel", texel);
    quad.Program->SetUniformf("radius", kRadius);
    return *quad.Program;
  };
  drawInto(*lit_, *aside_, window, [&] {
    begin(*obscure_).SetUniform2f("reach", reach);
    obscure_->Render();
  });
  drawn.Activate();
  lit_->Activate();
  drawInto(*shaded_, *aside_, window, [&] {
    vtkShaderProgram& program = begin(*darken_);
    program.SetUniformi("drawn", drawn.GetTextureUnit());
    program.SetUniformi("lit", lit_->GetTextureUnit());
    darken_->Render();
  });
  lit_->Deactivate();
  drawn.Deactivate();
  depths_->Deactivate();
  return *shaded_;
}

void Creases::release(vtkWindow* window) {
  for (vtkTextureObject* texture : {depths_.Get(), lit_.Get(), shaded_.Get()})
    texture->ReleaseGraphicsResources(window);
  aside_->ReleaseGraphicsResources(window);
  for (FlatQuad* quad : {&obscure_, &darken_}) {
    if (*quad) (*quad)->ReleaseGraphicsResources(window);
    quad->reset();
  }
}

}  // namespace palpa::scene
