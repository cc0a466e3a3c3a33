// The dust before what each second pixel of each second row shows: its radiance, and the share of the
// light behind it that passes. Places are relative to the eye, along W's axes.
#include "light.glsl"

uniform sampler2D u_depth;
uniform sampler3D u_cells;   // extinction for each metre, optical depth towards the sun
uniform sampler2D u_base;    // height of the ground
uniform sampler3D u_eddies;  // factor of the extinction
uniform mat3 u_R_WC;
uniform vec4 u_pixel_to_ray;
uniform float u_near_m;
uniform vec3 u_eye;  // in the frame of the cells' corner, height in W
uniform vec3 u_box_low, u_box_high;
uniform vec3 u_eddy_eye;
uniform float u_eddy_period_m;
uniform float u_cell_m;
uniform float u_step_m;
uniform vec3 u_size;
uniform vec3 u_scattered;
uniform float u_asymmetry;
uniform float u_diffuse_loss;

out vec4 o_light;

void main() {
  ivec2 pixel = min(2 * ivec2(gl_FragCoord.xy), textureSize(u_depth, 0) - 1);
  vec2 at = vec2(pixel) + 0.5;
  vec3 ray = u_R_WC * vec3(at * u_pixel_to_ray.zw + u_pixel_to_ray.xy, 1.0);
  vec3 d = normalize(ray);
  float depth = texelFetch(u_depth, pixel, 0).x;
  float end_m = depth > 0.0 ? u_near_m / depth * length(ray) : 1e9;
  vec3 a = u_box_low / d, b = u_box_high / d;
  vec3 nearer = min(a, b), farther = max(a, b);
  float from_m = max(max(nearer.x, nearer.y), max(nearer.z, 0.0));
  float to_m = min(min(farther.x, farther.y), min(farther.z, end_m));
  o_light = vec4(0.0, 0.0, 0.0, 1.0);
  if (from_m >= to_m) return;

  float c = dot(d, u_to_sun_W), g = u_asymmetry;
  float phase = (1.0 - g * g) / (4.0 * kPi * pow(1.0 + g * g - 2.0 * g * c, 1.5));
  vec3 mean = 0.5 * (SkyDiffuse(vec3(0.0, 0.0, 1.0)) + SkyDiffuse(vec3(0.0, 0.0, -1.0)));
  vec3 light = vec3(0.0);
  float passed = 1.0;
  int steps = int(ceil((to_m - from_m) / u_step_m));
  float step_m = (to_m - from_m) / float(steps);
  for (int s = 0; s < steps && passed > 0.002; ++s) {
    vec3 p = (from_m + (float(s) + 0.5) * step_m) * d;
    vec3 q = p + u_eye;
    vec2 uv = q.xy / (u_cell_m * u_size.xy);
    float height = max((q.z - texture(u_base, uv).x) / u_cell_m, 0.5);
    vec2 cell = texture(u_cells, vec3(uv, height / u_size.z)).xy;
    if (cell.x <= 0.0) continue;
    float extinction = cell.x * texture(u_eddies, (p + u_eddy_eye) / u_eddy_period_m).x;
    float direct = exp(-cell.y);
    vec3 source = mean + u_sun * (phase * direct + (1.0 - direct) * exp(-u_diffuse_loss * cell.y) /
                                                       (4.0 * kPi));
    float left = exp(-extinction * step_m);
    light += passed * (1.0 - left) * u_scattered * source;
    passed *= left;
  }
  o_light = vec4(min(light, vec3(1000.0)), passed);
}
