#ifdef WORN
#include "wear.glsl"
#endif

in vec3 v_relative_W;
in vec3 v_normal_W;
in vec2 v_uv;
flat in vec4 v_albedo_opacity;
flat in vec4 v_roughness_metallic;
flat in uint v_label;

#ifdef TEXTURED
// Bits of u_maps: 1 base colour, 2 metallic and roughness, 4 normal, 8 occlusion.
uniform int u_maps;
uniform sampler2D u_base_colour;
uniform sampler2D u_metallic_roughness;
uniform sampler2D u_normal_map;
uniform sampler2D u_occlusion_map;
uniform float u_normal_scale;
uniform float u_occlusion_strength;
#endif

layout(location = 0) out vec4 o_albedo_roughness;
layout(location = 1) out vec4 o_normal_metallic;
layout(location = 2) out uint o_label;

#ifdef TEXTURED
// The normal of a map: x along u, y against v, in the frame that position and coordinates span
// over the screen (Schueler 2006, Normal mapping without precomputed tangents).
vec3 Mapped(vec3 normal) {
  vec3 dp_x = dFdx(v_relative_W), dp_y = dFdy(v_relative_W);
  vec2 duv_x = dFdx(v_uv), duv_y = dFdy(v_uv);
  vec3 across_y = cross(dp_y, normal), across_x = cross(normal, dp_x);
  vec3 u = across_y * duv_x.x + across_x * duv_y.x;
  vec3 v = across_y * duv_x.y + across_x * duv_y.y;
  float largest = max(dot(u, u), dot(v, v));
  if (largest <= 0.0) return normal;
  float hand = dot(cross(dp_x, dp_y), normal) < 0.0 ? -1.0 : 1.0;  // of the screen's axes
  vec3 map = texture(u_normal_map, v_uv).xyz * 2.0 - 1.0;
  map.xy *= u_normal_scale;
  vec3 mapped = (u * map.x - v * map.y) * (hand * inversesqrt(largest)) + normal * map.z;
  return normalize(mapped);
}
#endif

void main() {
  // Thin sheets are seen from both sides.
  vec3 normal = normalize(v_normal_W);
  normal = dot(normal, v_relative_W) > 0.0 ? -normal : normal;
  vec3 root_albedo = v_albedo_opacity.rgb;
  vec2 roughness_metallic = v_roughness_metallic.xy;
  uint shut = 0u;  // 255 where none of the sky is seen
#ifdef TEXTURED
  if ((u_maps & 1) != 0) root_albedo *= sqrt(texture(u_base_colour, v_uv).rgb);
  if ((u_maps & 2) != 0) roughness_metallic *= texture(u_metallic_roughness, v_uv).gb;
  if ((u_maps & 4) != 0) normal = Mapped(normal);
  if ((u_maps & 8) != 0) {
    float open = mix(1.0, texture(u_occlusion_map, v_uv).r, u_occlusion_strength);
    shut = uint(round((1.0 - clamp(open, 0.0, 1.0)) * 255.0));
  }
#endif
#ifdef WORN
  Surface aged = Aged(Surface(root_albedo, roughness_metallic.x, roughness_metallic.y));
  root_albedo = aged.root_albedo;
  roughness_metallic = vec2(aged.roughness, aged.metallic);
#endif
  o_albedo_roughness = vec4(root_albedo, roughness_metallic.x);
  o_normal_metallic = vec4(normal * 0.5 + 0.5, roughness_metallic.y * 0.5);
  o_label = v_label | (shut << 24);
}
