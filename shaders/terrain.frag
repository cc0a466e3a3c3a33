in vec2 v_texture;
in vec2 v_position_W;

uniform sampler2D u_ground_albedo;
uniform sampler2D u_ground_shape;
uniform sampler2D u_detail;

layout(location = 0) out vec4 o_albedo_roughness;
layout(location = 1) out vec4 o_normal_metallic;
layout(location = 2) out uint o_label;

// The detail tile is laid at sides that share no small multiple, so that its repetition does not
// show: stones of 5 to 40 mm, crumbs of 2 to 15 mm, and, turned and blurred until no stone is left
// in it, patches of some decimetres and of some metres: as much of each scale, as nature has it.
const float kStones = 1.0 / 1.37, kCrumbs = 1.0 / 0.523, kPatches = 1.0 / 5.3, kZones = 1.0 / 41.0;
const float kStray = 1.5;  // texels
const float kPatchLevel = 3.0, kZoneLevel = 5.0;
const mat2 kTurn = mat2(0.8, 0.6, -0.6, 0.8), kTurnCrumbs = mat2(0.28, 0.96, -0.96, 0.28);

// A few numbers of 0 to 1 for a cell (Jarzynski and Olano 2020, pcg3d).
vec3 Chance(ivec2 cell, uint layer) {
  uvec3 v = uvec3(uvec2(cell), layer) * 1664525u + 1013904223u;
  v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
  v ^= v >> 16u;
  v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
  return vec3(v >> 8u) * (1.0 / 16777216.0);
}

// A loose stone in each cell of that size, or none: how far up its dome (xy) this place is, from -1
// to 1, its cover of the pixel (z), and how far it leans over the ground beside it (w).
vec4 Stone(vec2 place, float cell_m, uint layer, float share, float pixel_m, out float tone) {
  vec2 at = place / cell_m;
  ivec2 cell = ivec2(floor(at));
  vec3 chance = Chance(cell, layer), other = Chance(cell, layer + 17u);
  tone = other.z;
  if (chance.z > share) return vec4(0.0);
  float radius = mix(0.09, 0.30, other.x * other.x);
  vec2 from = (at - vec2(cell) - mix(vec2(radius + 0.1), vec2(0.9 - radius), chance.xy)) / radius;
  float turn = 6.2831853 * other.y, c = cos(turn), s = sin(turn);
  from = vec2(c * from.x + s * from.y, (c * from.y - s * from.x) * (1.0 + 0.7 * chance.x));
  // Its outline a little uneven: three and five lobes, sines of multiples of the angle.
  float reach = max(length(from), 1e-3), y = from.y / reach, y2 = y * y;
  float out_of = reach * (1.0 + 0.10 * (3.0 - 4.0 * y2) * y +
                          0.08 * ((16.0 * y2 - 20.0) * y2 + 5.0) * y);
  float edge = pixel_m / (radius * cell_m);  // of its outline, one pixel wide
  float fade = clamp(1.4 - 0.7 * edge, 0.0, 1.0);
  vec2 dome = vec2(c * from.x - s * from.y, s * from.x + c * from.y);
  return vec4(dome, fade * (1.0 - smoothstep(1.0 - edge, 1.0 + edge, out_of)),
              fade * (1.0 - smoothstep(1.0, 1.7, out_of)));
}

void main() {
  vec4 stones = texture(u_detail, v_position_W * kStones) * 2.0 - 1.0;
  vec4 crumbs = texture(u_detail, kTurnCrumbs * v_position_W * kCrumbs) * 2.0 - 1.0;
  vec4 patches = texture(u_detail, kTurn * v_position_W * kPatches, kPatchLevel) * 2.0 - 1.0;
  vec4 zones = texture(u_detail, v_position_W.yx * kZones, kZoneLevel) * 2.0 - 1.0;
  // One soil ends unevenly where another begins, not along the columns' sides.
  vec2 stray = kStray * (crumbs.yz + 0.7 * patches.yz) / vec2(textureSize(u_ground_albedo, 0));
  vec4 albedo = texture(u_ground_albedo, v_texture + stray);
  vec4 shape = texture(u_ground_shape, v_texture);
  float grain = shape.w * 2.0, loose = shape.z;
  // Where there are more crumbs and where there are fewer.
  float much = clamp(0.8 + 1.8 * patches.x + 1.2 * zones.x, 0.2, 1.7);
  vec2 slope = shape.xy - grain * (stones.yz * 0.60 + (crumbs.yz * kTurnCrumbs) * (0.55 * much) +
                                   (0.7 + 0.8 * loose) * (patches.yz * kTurn));
  float pixel_m = 0.5 * length(fwidth(v_position_W));
  if (shape.w < 0.0) {  // water: level, smooth, and mirroring as no ground does
    o_albedo_roughness = vec4(albedo.rgb * 0.75, 0.06);
    o_normal_metallic = vec4(0.5, 0.5, 1.0, 0.0);
    o_label = 1u;
    return;
  }
  float stony = smoothstep(0.38, 0.62, grain);
  float sky = albedo.a * (1.0 + grain * min(0.30 * stones.w + 0.30 * much * crumbs.w, 0.0));
  // Dark between the grains, and patches lighter and darker; square roots of albedo here.
  float tone = 1.0 + 0.18 * zones.x + 0.22 * patches.x +
               grain * (0.42 * stones.x + 0.16 * stones.w +
                        much * (0.40 * crumbs.x + 0.20 * crumbs.w));
  vec3 colour = albedo.rgb * max(tone, 0.3);
  // Stones of 1 to 4 cm, and of some millimetres; far away they are less than a pixel.
  uint layers = stony <= 0.0 || pixel_m > 0.03 ? 0u : pixel_m > 0.012 ? 1u : 2u;
  for (uint layer = 0u; layer < layers; ++layer) {
    float stone_tone;
    vec4 stone = Stone(v_position_W, layer == 0u ? 0.124 : 0.043, layer, 0.55 * stony * much,
                       pixel_m, stone_tone);
    colour *= 1.0 - 0.22 * stone.w * (1.0 - stone.z);
    sky *= 1.0 - 0.4 * stone.w * (1.0 - stone.z);
    vec3 grey = vec3(dot(albedo.rgb, vec3(0.3, 0.5, 0.2)));
    colour = mix(colour, mix(albedo.rgb, grey, 0.6) * (0.86 + 0.52 * stone_tone), stone.z);
    slope = mix(slope, shape.xy + 0.6 * stone.xy, stone.z);
  }
  slope *= min(1.0, 0.97 * inversesqrt(max(dot(slope, slope), 1e-6)));
  vec3 normal = vec3(slope, sqrt(max(0.0, 1.0 - dot(slope, slope))));
  o_albedo_roughness = vec4(min(colour, vec3(1.0)), 0.95);
  // The last channel: metallic in the lower half, the ground's sky factor in the upper.
  o_normal_metallic = vec4(normal * 0.5 + 0.5, 0.5 + 0.5 * clamp(sky, 0.01, 1.0));
  o_label = 1u;
}
