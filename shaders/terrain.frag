in vec2 v_texture;
in vec2 v_position_W;

uniform sampler2D u_ground_albedo;
uniform sampler2D u_ground_shape;
uniform sampler2D u_detail;

layout(location = 0) out vec4 o_albedo_roughness;
layout(location = 1) out vec4 o_normal_metallic;
layout(location = 2) out uint o_label;

// The detail tile is laid twice, at sides that share no small multiple, so that its repetition does
// not show; the coarse one is turned.
const float kFine = 1.0 / 1.37, kCoarse = 1.0 / 7.9;
const mat2 kTurn = mat2(0.8, 0.6, -0.6, 0.8);

void main() {
  vec4 albedo = texture(u_ground_albedo, v_texture);
  vec4 shape = texture(u_ground_shape, v_texture);
  vec4 fine = texture(u_detail, v_position_W * kFine) * 2.0 - 1.0;
  vec4 coarse = texture(u_detail, kTurn * v_position_W * kCoarse) * 2.0 - 1.0;
  float grain = shape.w * 2.0, loose = shape.z;
  vec2 slope = shape.xy - grain * (fine.yz * 0.55 + (0.25 + 0.35 * loose) * (coarse.yz * kTurn));
  slope *= min(1.0, 0.97 * inversesqrt(max(dot(slope, slope), 1e-6)));
  vec3 normal = vec3(slope, sqrt(max(0.0, 1.0 - dot(slope, slope))));
  // Dark between the grains, and patches lighter and darker; square roots of albedo here.
  float tone = 1.0 + 0.20 * coarse.x + grain * (0.16 * fine.x + 0.10 * fine.w + 0.06 * coarse.w);
  float sky = albedo.a * (1.0 + 0.25 * grain * min(fine.w + 0.3 * coarse.w, 0.0));
  o_albedo_roughness = vec4(albedo.rgb * tone, 0.95);
  // The last channel: metallic in the lower half, the ground's sky factor in the upper.
  o_normal_metallic = vec4(normal * 0.5 + 0.5, 0.5 + 0.5 * clamp(sky, 0.01, 1.0));
  o_label = 1u;
}
