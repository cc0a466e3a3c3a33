in vec2 v_position_W;
in vec3 v_normal_W;
in vec3 v_albedo_root;

uniform sampler2D u_detail;
uniform float u_tone;  // of the albedo's root, in rain
uniform float u_snow;  // share of the land that lies under it
uniform vec3 u_snow_root;

layout(location = 0) out vec4 o_albedo_roughness;
layout(location = 1) out vec4 o_normal_metallic;
layout(location = 2) out uint o_label;

void main() {
  vec4 coarse = texture(u_detail, v_position_W * (1.0 / 9.7)) * 2.0 - 1.0;
  vec4 broad = texture(u_detail, v_position_W.yx * (1.0 / 130.0)) * 2.0 - 1.0;
  vec3 normal = normalize(v_normal_W - vec3(0.3 * coarse.yz, 0.0));
  vec3 root = v_albedo_root * (1.0 + 0.22 * coarse.x + 0.25 * broad.x);
  if (u_tone < 1.0) root *= u_tone;
  if (u_snow > 0.0) root = mix(root, u_snow_root, u_snow * (1.0 - 0.35 * max(broad.x, 0.0)));
  o_albedo_roughness = vec4(root, 0.95);
  o_normal_metallic = vec4(normal * 0.5 + 0.5, 0.97);
  o_label = 1u;
}
