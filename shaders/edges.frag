// Smooths stair steps: where brightness changes sharply, the pixel is sampled along the edge.
// Idea: Lottes 2009, "FXAA".

uniform sampler2D u_colour;

out vec4 o_colour;

void main() {
  ivec2 p = ivec2(gl_FragCoord.xy), last = textureSize(u_colour, 0) - 1;
  vec4 m = texelFetch(u_colour, p, 0);
  float nw = texelFetch(u_colour, clamp(p + ivec2(-1, -1), ivec2(0), last), 0).a;
  float ne = texelFetch(u_colour, clamp(p + ivec2(1, -1), ivec2(0), last), 0).a;
  float sw = texelFetch(u_colour, clamp(p + ivec2(-1, 1), ivec2(0), last), 0).a;
  float se = texelFetch(u_colour, clamp(p + ivec2(1, 1), ivec2(0), last), 0).a;
  float low = min(m.a, min(min(nw, ne), min(sw, se)));
  float high = max(m.a, max(max(nw, ne), max(sw, se)));
  vec2 along = vec2((sw + se) - (nw + ne), (nw + sw) - (ne + se));
  float damp = max((nw + ne + sw + se) * 0.03, 0.008);
  along = clamp(along / (min(abs(along.x), abs(along.y)) + damp), -6.0, 6.0);
  vec2 texel = 1.0 / vec2(last + 1), at = gl_FragCoord.xy * texel;
  vec3 narrow = 0.5 * (texture(u_colour, at + along * texel * (-1.0 / 6.0)).rgb +
                       texture(u_colour, at + along * texel * (1.0 / 6.0)).rgb);
  vec4 ends = 0.5 * (texture(u_colour, at - along * texel * 0.5) +
                     texture(u_colour, at + along * texel * 0.5));
  vec3 wide = 0.5 * narrow + 0.5 * ends.rgb;
  float luma = dot(wide, vec3(0.299, 0.587, 0.114));
  vec3 smooth_colour = luma < low || luma > high ? narrow : wide;
  o_colour = vec4(high - low > max(0.04, 0.12 * high) ? smooth_colour : m.rgb, 1.0);
}
