// From radiance to sRGB; the last channel is luma for the edge filter.

#include "tone.glsl"

uniform sampler2D u_radiance;

out vec4 o_colour;

void main() {
  vec3 srgb = Toned(texelFetch(u_radiance, ivec2(gl_FragCoord.xy), 0).rgb);
  o_colour = vec4(srgb, Luma(srgb));
}
