in vec2 v_texture;

uniform sampler2D u_albedo;
uniform sampler2D u_shape;

layout(location = 0) out vec4 o_albedo_roughness;
layout(location = 1) out vec4 o_normal_metallic;
layout(location = 2) out uint o_label;

void main() {
  vec4 albedo = texture(u_albedo, v_texture);
  vec2 slope = texture(u_shape, v_texture).xy * 2.0 - 1.0;
  vec3 normal = vec3(slope, sqrt(max(0.0, 1.0 - dot(slope, slope))));
  o_albedo_roughness = vec4(albedo.rgb, 0.95);
  o_normal_metallic = vec4(normal * 0.5 + 0.5, 0.0);
  o_label = 1u;
}
