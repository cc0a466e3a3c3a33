// Filmic curve and sRGB encoding (IEC 61966-2-1) of linear values, 1 the brightest before the curve.
// Curve: Narkowicz 2015, "ACES filmic tone mapping curve" (a rational fit).

vec3 Curve(vec3 x) { return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14); }

vec3 Toned(vec3 linear) {
  const float kGain = 1.35;
  vec3 x = clamp(Curve(kGain * linear), 0.0, 1.0);
  return mix(x * 12.92, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, x));
}

float Luma(vec3 srgb) { return dot(srgb, vec3(0.299, 0.587, 0.114)); }
