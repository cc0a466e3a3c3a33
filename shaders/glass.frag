#include "light.glsl"

in vec3 v_relative_W;
in vec3 v_normal_W;
flat in vec4 v_albedo_opacity;
flat in vec4 v_roughness_metallic;

out vec4 o_radiance;

void main() {
  float range_m = length(v_relative_W);
  vec3 v = -v_relative_W / range_m, n = normalize(v_normal_W);
  n = dot(n, v) < 0.0 ? -n : n;
  float n_v = max(dot(n, v), 1e-3), roughness = max(v_roughness_metallic.x, 0.06);
  float fresnel = 0.04 + 0.96 * FresnelPower(n_v);
  vec3 albedo = v_albedo_opacity.rgb * v_albedo_opacity.rgb;
  vec3 h = normalize(v + u_to_sun_W);
  float n_l = max(dot(n, u_to_sun_W), 0.0);
  vec3 tint = albedo * (n_l / kPi * u_sun + SkyDiffuse(n)) * v_albedo_opacity.a;
  vec3 mirror = fresnel * Reflected(reflect(-v, n), roughness) +
                0.04 * min(Specular(n_l, n_v, max(dot(n, h), 0.0), roughness), 200.0) * u_sun;
  float cover = clamp(v_albedo_opacity.a + fresnel, 0.0, 1.0);
  o_radiance = vec4(min(Fog(tint + mirror, -v, range_m), vec3(1000.0)), cover);
}
