#pragma once

/// What compositor.h states, for the graphics processor.
namespace palpa::scene::glsl {

inline constexpr const char* kBegin = R"(//VTK::System::Dec
in vec2 texCoord;
//VTK::Output::Dec
uniform sampler2D drawn;
uniform vec2 texel;
vec4 drawnAt(vec2 at) { return textureLod(drawn, at, 0.0); }
)";

/// Along an edge that is nearly a row or a column of pixels, as far as it is seen to go: the pixel
/// takes from beyond the edge what the straight edge would leave to it.
inline constexpr const char* kSmooth = R"(
const int kSteps = 13;
const float kStep[13] = float[](1., 1., 1., 1., 1., 1., 1., 1., 2., 2., 2., 2., 4.);

float level(vec4 c) { return dot(c, vec4(0.15, 0.30, 0.05, 0.50)); }
float levelAt(vec2 at) { return level(drawnAt(at)); }

/// How far from `from` the edge goes on in steps of `along`, and what it ends in.
vec2 endOf(vec2 from, vec2 along, float middle, float slope) {
  float far = 0.0, here = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    far += kStep[i];
    here = levelAt(from + far * along) - middle;
    if (abs(here) >= slope) break;
  }
  return vec2(far, here);
}

vec4 smoothed(vec2 at) {
  vec4 own = drawnAt(at);
  vec2 x = vec2(texel.x, 0.0), y = vec2(0.0, texel.y);
  float c = level(own), n = levelAt(at + y), s = levelAt(at - y), e = levelAt(at + x),
        w = levelAt(at - x);
  float low = min(c, min(min(n, s), min(e, w))), high = max(c, max(max(n, s), max(e, w)));
  if (high - low < max(0.016, 0.08 * high)) return own;
  float ne = levelAt(at + y + x), nw = levelAt(at + y - x), se = levelAt(at - y + x),
        sw = levelAt(at - y - x);
  float bend_y = abs(nw + sw - 2.0 * w) + 2.0 * abs(n + s - 2.0 * c) + abs(ne + se - 2.0 * e);
  float bend_x = abs(nw + ne - 2.0 * n) + 2.0 * abs(w + e - 2.0 * c) + abs(sw + se - 2.0 * s);
  bool flat_lying = bend_y >= bend_x;
  vec2 along = flat_lying ? x : y, across = flat_lying ? y : x;
  float above = flat_lying ? n : e, below = flat_lying ? s : w;
  if (abs(below - c) > abs(above - c)) {
    across = -across;
    above = below;
  }
  float middle = 0.5 * (c + above), slope = 0.25 * abs(above - c);
  vec2 start = at + 0.5 * across;
  vec2 one = endOf(start, along, middle, slope), other = endOf(start, -along, middle, slope);
  vec2 nearer = one.x < other.x ? one : other;
  // A step of a staircase: it ends in what is on the other side, and goes on one pixel deeper. A
  // corner does not go on.
  float deeper = levelAt(at + (nearer.x + 0.5) * (one.x < other.x ? along : -along) - across);
  bool ours = (nearer.y < 0.0) != (c < middle) && abs(nearer.y) < 3.0 * slope &&
              abs(deeper - c) < abs(deeper - above);
  float share = ours ? 0.5 - nearer.x / (one.x + other.x) : 0.0;
  // What is one pixel wide has no side to take from: it takes from all around.
  float around = (2.0 * (n + s + e + w) + ne + nw + se + sw) / 12.0;
  float thin = smoothstep(0.0, 1.0, clamp(abs(around - c) / (high - low), 0.0, 1.0));
  share = max(share, 0.75 * thin * thin);
  return drawnAt(at + share * across);
}
)";

inline constexpr const char* kSmoothOnly = R"(
void main() { gl_FragData[0] = smoothed(texCoord); }
)";

inline constexpr const char* kJagged = R"(
vec4 overlay(vec2 at) { return drawnAt(at); }
)";

inline constexpr const char* kSharp = R"(
vec4 overlay(vec2 at) { return smoothed(at); }
)";

/// A Gaussian by pairs of pixels, each pair one look-up between them.
inline constexpr const char* kBlur = R"(
uniform int pairs;
uniform float place[5], weight[5], reach;

vec4 overlay(vec2 at) {
  vec4 own = drawnAt(at);
  vec2 r = reach * texel;
  vec4 a = drawnAt(at + r), b = drawnAt(at - r), c = drawnAt(at + vec2(r.x, -r.y)),
       d = drawnAt(at + vec2(-r.x, r.y));
  vec4 spread = max(own, max(max(a, b), max(c, d))) - min(own, min(min(a, b), min(c, d)));
  if (max(max(spread.r, spread.g), max(spread.b, spread.a)) < 0.012) return own;
  vec4 sum = vec4(0.0);
  for (int i = -pairs; i <= pairs; ++i) {
    float up = i < 0 ? -place[-i] : place[i], part = weight[abs(i)];
    for (int k = -pairs; k <= pairs; ++k) {
      float right = k < 0 ? -place[-k] : place[k];
      sum += part * weight[abs(k)] * drawnAt(at + vec2(right, up) * texel);
    }
  }
  return sum;
}
)";

inline constexpr const char* kOver = R"(
uniform sampler2D picture, grain;
uniform vec2 grain_scale, grain_place;
uniform vec3 black, white;
uniform float grain_strength[5], grain_colour, grain_unit;
uniform int channels;

void main() {
  vec4 o = overlay(texCoord);
  if (channels == 0) {
    gl_FragData[0] = vec4(o.rgb, 1.0);
    return;
  }
  vec2 at = vec2(texCoord.x, 1.0 - texCoord.y);
  vec4 seen = textureLod(picture, at, 0.0);
  if (channels == 1) seen = seen.rrrr;
  vec3 pixel = seen.rgb;
  if (o.a > 0.0) {
    vec3 drawn_here = black * o.a + (white - black) * o.rgb;
    float bright = clamp(dot(o.rgb, vec3(1.0 / 3.0)) / o.a, 0.0, 1.0);
    float level = 4.0 * bright;
    int below = min(int(level), 3);
    float strength = mix(grain_strength[below], grain_strength[below + 1], level - float(below)) *
                     sqrt(o.a * (2.0 - o.a));
    vec3 noise = textureLod(grain, at * grain_scale + grain_place, 0.0).rgb - 128.0 / 255.0;
    noise = mix(noise.rrr, noise, grain_colour) * grain_unit;
    pixel = drawn_here + strength * noise + (1.0 - o.a) * pixel;
  }
  gl_FragData[0] = vec4(pixel, 1.0);
}
)";

}  // namespace palpa::scene::glsl
