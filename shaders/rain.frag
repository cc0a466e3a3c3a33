// A streak of a drop, which shines with the light around it.
#include "light.glsl"

flat in float v_cover;

uniform float u_share;

out vec4 o_radiance;

void main() {
  vec3 mean = 0.5 * (SkyDiffuse(vec3(0.0, 0.0, 1.0)) + SkyDiffuse(vec3(0.0, 0.0, -1.0)));
  o_radiance = vec4(u_share * mean * v_cover, v_cover);
}
