// Mean over the 4 x 4 block of turns of the occlusion pass.
uniform sampler2D u_occlusion;

out float o_open;

void main() {
  vec2 texel = 1.0 / vec2(textureSize(u_occlusion, 0)), at = gl_FragCoord.xy * texel;
  o_open = 0.25 * (texture(u_occlusion, at + vec2(-1.0, -1.0) * texel).x +
                   texture(u_occlusion, at + vec2(1.0, -1.0) * texel).x +
                   texture(u_occlusion, at + vec2(-1.0, 1.0) * texel).x +
                   texture(u_occlusion, at + vec2(1.0, 1.0) * texel).x);
}
