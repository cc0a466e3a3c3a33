// How much of the sky nearby surfaces hide, from the depth picture, at half resolution.
// Model: McGuire et al. 2011, "The Alchemy screen-space ambient obscurance algorithm", eq. 10.

uniform sampler2D u_depth;
uniform sampler2D u_normal;
uniform mat3 u_R_WC;
uniform vec4 u_pixel_to_ray;
uniform float u_near_m;
uniform float u_focal_px;

out float o_open;

const int kSamples = 8;
const float kRadius_m = 0.55;

vec3 At(ivec2 pixel) {
  float depth = texelFetch(u_depth, pixel, 0).x;
  return vec3((vec2(pixel) + 0.5) * u_pixel_to_ray.zw + u_pixel_to_ray.xy, 1.0) *
         (u_near_m / max(depth, 1e-6));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy) * 2, size = textureSize(u_depth, 0);
  float depth = texelFetch(u_depth, pixel, 0).x;
  vec3 p = At(pixel);
  vec3 n = normalize((texelFetch(u_normal, pixel, 0).xyz * 2.0 - 1.0) * u_R_WC);
  float reach_px = min(kRadius_m * u_focal_px / p.z, 90.0);
  // A different turn for each pixel of a 4 x 4 block; the shading pass blurs over the block.
  int turn = (int(gl_FragCoord.x) & 3) * 4 + (int(gl_FragCoord.y) & 3);
  float phase = float((turn * 7) & 15) * 0.3927;
  float sum = 0.0;
  for (int s = 0; s < kSamples; ++s) {
    float r = (float(s) + 0.5) / float(kSamples), angle = phase + float(s) * 2.39996;
    ivec2 q = pixel + ivec2(reach_px * r * vec2(cos(angle), sin(angle)));
    vec3 away = At(clamp(q, ivec2(0), size - 1)) - p;
    float d2 = dot(away, away);
    float fall = max(kRadius_m * kRadius_m - d2, 0.0);
    sum += max(dot(away, n) - 0.004 * p.z, 0.0) * fall * fall / (d2 + 0.01);
  }
  float r4 = kRadius_m * kRadius_m * kRadius_m * kRadius_m;
  o_open = depth > 0.0 ? max(0.0, 1.0 - 1.3 * sum / (r4 * float(kSamples))) : 1.0;
}
