#include "light.glsl"

uniform sampler2D u_sky;
uniform mat3 u_R_WC;
uniform vec4 u_pixel_to_ray;
uniform float u_exposure;

out vec4 o_radiance;

void main() {
  vec3 d = normalize(u_R_WC * vec3(gl_FragCoord.xy * u_pixel_to_ray.zw + u_pixel_to_ray.xy, 1.0));
  float u = atan(d.y, d.x) / (2.0 * kPi), v = sqrt(max(d.z, 0.0));
  vec3 sky = textureLod(u_sky, vec2(u, v), 0.0).rgb * u_exposure;
  // The sun's own disc, with a soft edge, half a degree across.
  float disc = smoothstep(0.99997, 0.99999, dot(d, u_to_sun_W));
  sky += disc * u_sun * 50.0;
  o_radiance = vec4(d.z > 0.0 ? min(sky, vec3(1000.0)) : Airlight(d), 1.0);
}
