// Bodies of a pinhole picture in the camera's own, which its lens distorts: those of the nearest
// pixel, as distort.frag takes labels.

uniform usampler2D u_body;
uniform sampler2D u_map;  // as in distort.frag
uniform int u_view;

layout(location = 0) out uint o_body;

void main() {
  vec4 source = texelFetch(u_map, ivec2(gl_FragCoord.xy), 0);
  if (int(source.z) != u_view) discard;
  ivec2 last = textureSize(u_body, 0) - 1;
  o_body = texelFetch(u_body, clamp(ivec2(floor(source.xy + 0.5)), ivec2(0), last), 0).x;
}
