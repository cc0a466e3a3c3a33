// Light on surfaces of a pinhole picture in the camera's own, which its lens distorts: that of the
// nearest pixel, as distort.frag takes labels.

uniform sampler2D u_light;
uniform sampler2D u_map;  // as in distort.frag
uniform int u_view;

layout(location = 0) out vec2 o_light;

void main() {
  vec4 source = texelFetch(u_map, ivec2(gl_FragCoord.xy), 0);
  if (int(source.z) != u_view) discard;
  ivec2 last = textureSize(u_light, 0) - 1;
  o_light = texelFetch(u_light, clamp(ivec2(floor(source.xy + 0.5)), ivec2(0), last), 0).xy;
}
