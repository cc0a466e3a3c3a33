in vec3 v_relative_W;
in vec3 v_normal_W;
flat in vec4 v_albedo_opacity;
flat in vec4 v_roughness_metallic;
flat in uint v_label;

layout(location = 0) out vec4 o_albedo_roughness;
layout(location = 1) out vec4 o_normal_metallic;
layout(location = 2) out uint o_label;

void main() {
  // Thin sheets are seen from both sides.
  vec3 normal = normalize(v_normal_W);
  normal = dot(normal, v_relative_W) > 0.0 ? -normal : normal;
  o_albedo_roughness = vec4(v_albedo_opacity.rgb, v_roughness_metallic.x);
  o_normal_metallic = vec4(normal * 0.5 + 0.5, v_roughness_metallic.y * 0.5);
  o_label = v_label;
}
