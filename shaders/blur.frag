// Mean over the 4 x 4 block of turns of the occlusion pass.
uniform sampler2D u_occlusion;

out float o_open;

void main() {
  vec2 texel = 1.0 / vec2(textureSize(u_occlusion, 0)), at = gl_FragCoord.xy * texel;
  // Between the centres of texels -2 and -1, and 0 and 1: each look is the mean of four.
  const float kLow = -1.5, kHigh = 0.5;
  o_open = 0.25 * (texture(u_occlusion, at + vec2(kLow, kLow) * texel).x +
                   texture(u_occlusion, at + vec2(kHigh, kLow) * texel).x +
                   texture(u_occlusion, at + vec2(kLow, kHigh) * texel).x +
                   texture(u_occlusion, at + vec2(kHigh, kHigh) * texel).x);
}
