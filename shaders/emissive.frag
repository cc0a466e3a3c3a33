#include "light.glsl"

// Light that surfaces give themselves, added to what they reflect.

in vec3 v_relative_W;
in vec2 v_uv;

uniform int u_maps;
uniform sampler2D u_emissive_map;
uniform vec3 u_emission;   // over a white sheet in full sun
uniform float u_full_sun;  // illuminance of a clear noon

out vec4 o_radiance;

void main() {
  vec3 emission = u_emission;
  if ((u_maps & 16) != 0) emission *= texture(u_emissive_map, v_uv).rgb;
  float range_m = length(v_relative_W);
  float left = exp(-u_extinction_1pm * range_m);
  o_radiance = vec4(min(emission * (u_full_sun / kPi * left), vec3(1000.0)), 0.0);
}
