// From a pinhole picture to the part of the camera's own, which its lens distorts, that comes from it. Colour is blended; labels
// and normals are those of the nearest pixel; depth is blended as 1 / Z, which is exact on planes, where the
// four pixels around belong to one smooth surface, else it is the nearest pixel's. NORMALS: with normals.

uniform sampler2D u_colour;
uniform sampler2D u_depth;
uniform usampler2D u_label;
uniform sampler2D u_normal;
// Source position in pixels, centre of the first at (0, 0); the source's number; depth here over depth there.
uniform sampler2D u_map;
uniform int u_view;  // number of the source

layout(location = 0) out vec4 o_colour;
layout(location = 1) out uint o_label;
layout(location = 2) out float o_depth;
#ifdef NORMALS
layout(location = 3) out vec4 o_normal;
#endif

void main() {
  vec4 source = texelFetch(u_map, ivec2(gl_FragCoord.xy), 0);
  if (int(source.z) != u_view) discard;
  vec2 at = source.xy;
  ivec2 last = textureSize(u_depth, 0) - 1;
  ivec2 corner = clamp(ivec2(floor(at)), ivec2(0), last - 1);
  vec2 f = clamp(at - vec2(corner), 0.0, 1.0);
  bvec2 beyond = greaterThanEqual(f, vec2(0.5));  // the nearest pixel is not the corner's
  o_colour = texture(u_colour, (at + 0.5) / vec2(last + 1));
#ifdef NORMALS
  o_normal = texelFetch(u_normal, corner + ivec2(beyond), 0);
#endif
  float d00 = texelFetch(u_depth, corner, 0).x;
  float d10 = texelFetch(u_depth, corner + ivec2(1, 0), 0).x;
  float d01 = texelFetch(u_depth, corner + ivec2(0, 1), 0).x;
  float d11 = texelFetch(u_depth, corner + ivec2(1, 1), 0).x;
  uint l00 = texelFetch(u_label, corner, 0).x, l10 = texelFetch(u_label, corner + ivec2(1, 0), 0).x;
  uint l01 = texelFetch(u_label, corner + ivec2(0, 1), 0).x;
  uint l11 = texelFetch(u_label, corner + ivec2(1, 1), 0).x;
  o_label = beyond.y ? (beyond.x ? l11 : l01) : (beyond.x ? l10 : l00);
  float nearest = beyond.y ? (beyond.x ? d11 : d01) : (beyond.x ? d10 : d00);
  float low = min(min(d00, d10), min(d01, d11)), high = max(max(d00, d10), max(d01, d11));
  // On a plane opposite corners have the same sum; rough ground may bend by a quarter of the spread.
  bool flat_patch = abs(d00 + d11 - d10 - d01) <= 0.25 * (high - low) + 2e-6 * high;
  bool one_surface = l00 == l10 && l00 == l01 && l00 == l11 && low > 0.0;
  float blended = mix(mix(d00, d10, f.x), mix(d01, d11, f.x), f.y);
  o_depth = (flat_patch && one_surface ? blended : nearest) / source.w;
}
