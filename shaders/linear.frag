// Radiance as it is; the last channel is the luma that it would have in sRGB, for the edge filter.

#include "tone.glsl"

uniform sampler2D u_radiance;

out vec4 o_colour;

void main() {
  vec3 linear = texelFetch(u_radiance, ivec2(gl_FragCoord.xy), 0).rgb;
  o_colour = vec4(linear, Luma(Toned(linear)));
}
