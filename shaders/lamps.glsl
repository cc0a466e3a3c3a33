// Spotlights. Intensities are multiplied by the exposure, as in light.glsl.

const int kMostLamps = 8;

uniform sampler2DShadow u_lamp_shadow;  // a square for each lamp, side by side
uniform int u_lamp_count;
uniform vec3 u_lamp_place[kMostLamps];     // relative to the eye
uniform vec3 u_lamp_beam[kMostLamps];      // unit vector
uniform vec3 u_lamp_strength[kMostLamps];  // intensity in the beam; half angle; metres a texel at 1 m
uniform mat4 u_lamp_clip[kMostLamps];      // of positions relative to the eye

// Illuminance of a plane that faces lamp k, from the direction `to_lamp` (unit).
float LampLight(int k, vec3 relative, vec3 normal, out vec3 to_lamp) {
  vec3 way = u_lamp_place[k] - relative;
  float distance_m = max(length(way), 0.05);
  to_lamp = way / distance_m;
  float off = acos(clamp(dot(-to_lamp, u_lamp_beam[k]), -1.0, 1.0)) / u_lamp_strength[k].y;
  if (off >= 1.0) return 0.0;
  float pattern = 1.0 - off * off;
  vec3 leave = normal * (2.0 * u_lamp_strength[k].z * distance_m);
  vec4 clip = u_lamp_clip[k] * vec4(relative + leave, 1.0);
  vec3 p = clip.xyz / clip.w;
  vec2 texel = 1.0 / vec2(textureSize(u_lamp_shadow, 0));
  float width = texel.x / texel.y;  // of a lamp's square in the texture
  vec2 inside = clamp(p.xy * 0.5 + 0.5, texel.y, 1.0 - texel.y);
  vec3 at = vec3((inside.x + float(k)) * width, inside.y, min(p.z, 1.0));
  float lit = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 d = vec2((i & 1) == 0 ? -0.5 : 0.5, (i & 2) == 0 ? -0.5 : 0.5) * texel;
    lit += 0.25 * texture(u_lamp_shadow, at + vec3(d, 0.0));
  }
  return u_lamp_strength[k].x * pattern * pattern * lit / (distance_m * distance_m);
}
