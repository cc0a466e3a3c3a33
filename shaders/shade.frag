#include "light.glsl"
#ifdef LAMPS
#include "lamps.glsl"
#endif

uniform sampler2D u_albedo;
uniform sampler2D u_normal;
uniform sampler2D u_depth;
uniform sampler2D u_occlusion;
uniform usampler2D u_label;  // bits 24 to 31: share of the sky that a node's own map shuts out
uniform sampler2D u_ground_shadow;
uniform sampler2DShadow u_shadow;
uniform mat3 u_R_WC;
uniform vec4 u_pixel_to_ray;  // (x, y) at Z = 1 is pixel * zw + xy
uniform float u_near_m;
uniform vec3 u_eye_W;
uniform vec2 u_ground_scale;
uniform vec2 u_ground_origin;
uniform float u_ground_penumbra_m;
uniform mat4 u_shadow_near;
uniform mat4 u_shadow_far;
uniform vec4 u_shadow_near_square;
uniform vec4 u_shadow_far_square;
uniform vec2 u_shadow_texel_m;
uniform vec2 u_shadow_texel;

layout(location = 0) out vec4 o_radiance;
layout(location = 1) out vec2 o_light;  // illuminance, and the share of the sun; not always taken

bool Inside(vec3 p, float margin) {
  return all(greaterThan(p.xy, vec2(margin))) && all(lessThan(p.xy, vec2(1.0 - margin)));
}

// 1 where the sun is seen past the nodes. The filter below reaches 2.1 texels: a plane tilted by
// theta from the sun's must be left by that times sin(theta) along its normal not to shade itself.
float NodeShadow(vec3 relative, vec3 normal) {
  float n_l = dot(normal, u_to_sun_W);
  vec3 leave = normal * (0.4 + 2.1 * sqrt(max(1.0 - n_l * n_l, 0.0)));
  vec3 p = (u_shadow_near * vec4(relative + leave * u_shadow_texel_m.x, 1.0)).xyz;
  vec4 square = u_shadow_near_square;
  bool covered = true;
  if (!Inside(p, 0.003)) {
    p = (u_shadow_far * vec4(relative + leave * u_shadow_texel_m.y, 1.0)).xyz;
    square = u_shadow_far_square;
    covered = Inside(p, 0.003);
  }
  vec3 at = vec3(p.xy * square.xy + square.zw, min(p.z, 1.0));
  vec2 d = u_shadow_texel;
  float lit = texture(u_shadow, at + vec3(-0.4 * d.x, -1.1 * d.y, 0.0)) +
              texture(u_shadow, at + vec3(1.1 * d.x, -0.4 * d.y, 0.0)) +
              texture(u_shadow, at + vec3(0.4 * d.x, 1.1 * d.y, 0.0)) +
              texture(u_shadow, at + vec3(-1.1 * d.x, 0.4 * d.y, 0.0));
  return covered ? lit * 0.25 : 1.0;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(u_depth, pixel, 0).x;
  vec4 albedo_roughness = texelFetch(u_albedo, pixel, 0);
  vec4 normal_metallic = texelFetch(u_normal, pixel, 0);
  vec3 albedo = albedo_roughness.rgb * albedo_roughness.rgb;
  vec3 n = normalize(normal_metallic.xyz * 2.0 - 1.0);
  bool is_ground = normal_metallic.w > 0.502;
  float metallic = is_ground ? 0.0 : normal_metallic.w * 2.0;
  float sky_factor = is_ground ? normal_metallic.w * 2.0 - 1.0 : 1.0;
  float roughness = max(albedo_roughness.a, 0.06);

  vec3 ray = u_R_WC * vec3(gl_FragCoord.xy * u_pixel_to_ray.zw + u_pixel_to_ray.xy, 1.0);
  vec3 relative = ray * (u_near_m / depth);
  float range_m = length(relative);
  vec3 v = -relative / range_m;

  vec3 position = relative + u_eye_W;
  float shade_m = texture(u_ground_shadow, (position.xy - u_ground_origin) * u_ground_scale).x;
  float sun = clamp((position.z - shade_m) / u_ground_penumbra_m, 0.0, 1.0);
  sun *= NodeShadow(relative, n);
  float occlusion = texture(u_occlusion, gl_FragCoord.xy / vec2(textureSize(u_depth, 0))).x;

  vec3 h = normalize(v + u_to_sun_W);
  float n_l = max(dot(n, u_to_sun_W), 0.0), n_v = max(dot(n, v), 1e-3);
  vec3 f0 = mix(vec3(0.04), albedo, metallic);
  vec3 fresnel = f0 + (1.0 - f0) * FresnelPower(dot(v, h));
  vec3 direct = albedo * ((1.0 - metallic) * n_l / kPi);
  if (!is_ground) direct += fresnel * Specular(n_l, n_v, max(dot(n, h), 0.0), roughness);
  vec3 radiance = min(direct * sun, vec3(20.0)) * u_sun;

  float light_on_it = dot(u_sun * (n_l * sun), kLuminous);

#ifdef LAMPS
  for (int k = 0; k < u_lamp_count; ++k) {
    vec3 l;
    float light = LampLight(k, relative, n, l);
    float n_lamp = max(dot(n, l), 0.0);
    if (light * n_lamp <= 0.0) continue;
    light_on_it += light * n_lamp;
    vec3 half_way = normalize(v + l);
    vec3 reflected = albedo * ((1.0 - metallic) * n_lamp / kPi);
    if (!is_ground) {
      vec3 sheen = f0 + (1.0 - f0) * FresnelPower(dot(v, half_way));
      reflected += sheen * Specular(n_lamp, n_v, max(dot(n, half_way), 0.0), roughness);
    }
    radiance += min(reflected, vec3(20.0)) * light;
  }
#endif

  float shut = float(texelFetch(u_label, pixel, 0).x >> 24) / 255.0;
  float open = sky_factor * occlusion * (1.0 - shut);
  vec3 sky = SkyDiffuse(n);
  radiance += albedo * ((1.0 - metallic) * open) * sky;
  light_on_it += kPi * open * dot(sky, kLuminous);
  o_light = vec2(light_on_it, n_l > 0.0 && u_sun.g > 0.0 ? sun : 0.0);
  if (!is_ground) {
    vec3 env = f0 + (max(vec3(1.0 - roughness), f0) - f0) * FresnelPower(n_v);
    radiance += env * open * Reflected(reflect(-v, n), roughness);
  }
  o_radiance = vec4(min(Fog(radiance, -v, range_m), vec3(1000.0)), 1.0);
}
