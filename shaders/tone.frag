// Filmic curve and sRGB encoding (IEC 61966-2-1); the last channel is luma for the edge filter.
// Curve: Hable 2010, "Uncharted 2: HDR lighting".

uniform sampler2D u_radiance;

out vec4 o_colour;

vec3 Curve(vec3 x) {
  const float a = 0.22, b = 0.30, c = 0.10, d = 0.20, e = 0.01, f = 0.30;
  return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
}

void main() {
  const float kWhite = 6.0;
  vec3 linear = texelFetch(u_radiance, ivec2(gl_FragCoord.xy), 0).rgb;
  vec3 x = clamp(Curve(linear * 2.4) / Curve(vec3(kWhite)), 0.0, 1.0);
  vec3 srgb = mix(x * 12.92, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, x));
  o_colour = vec4(srgb, dot(srgb, vec3(0.299, 0.587, 0.114)));
}
