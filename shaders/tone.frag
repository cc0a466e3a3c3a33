// Filmic curve and sRGB encoding (IEC 61966-2-1); the last channel is luma for the edge filter.
// Curve: Narkowicz 2015, "ACES filmic tone mapping curve" (a rational fit).

uniform sampler2D u_radiance;

out vec4 o_colour;

vec3 Curve(vec3 x) { return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14); }

void main() {
  const float kGain = 1.35;
  vec3 linear = texelFetch(u_radiance, ivec2(gl_FragCoord.xy), 0).rgb;
  vec3 x = clamp(Curve(kGain * linear), 0.0, 1.0);
  vec3 srgb = mix(x * 12.92, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, x));
  o_colour = vec4(srgb, dot(srgb, vec3(0.299, 0.587, 0.114)));
}
