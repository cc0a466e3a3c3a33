in vec2 v_position_W;
in vec3 v_normal_W;

uniform sampler2D u_detail;
uniform sampler2D u_ground_albedo;
uniform vec2 u_ground_scale;
uniform vec2 u_ground_origin;
uniform vec2 u_site_low_W;  // the site's corners
uniform vec2 u_site_high_W;
uniform float u_tone;  // of the albedo's root, in rain
uniform float u_snow;  // share of the land that lies under it
uniform vec3 u_snow_root;

layout(location = 0) out vec4 o_albedo_roughness;
layout(location = 1) out vec4 o_normal_metallic;
layout(location = 2) out uint o_label;

const float kTexels = 512.0;        // of the detail's side
const mat2 kTurn = mat2(0.8, 0.6, -0.6, 0.8), kFieldTurn = mat2(0.93, 0.37, -0.37, 0.93);
// Albedo of trodden soil over that of the site; of grass, dry grass, woods, straw, ploughed land.
const float kTrodden = 0.86;
const vec3 kGrass = vec3(0.105, 0.125, 0.045), kLush = vec3(0.075, 0.115, 0.035), kHay = vec3(0.25, 0.215, 0.11);
const vec3 kWoods = vec3(0.040, 0.058, 0.026), kStraw = vec3(0.31, 0.25, 0.13), kEarth = vec3(0.17, 0.125, 0.085);

// The detail at a tile of that size, without what is smaller than its texels of that level or than a pixel.
vec4 Detail(vec2 place, float tile_m, float level, float pixel_m) {
  float finest = log2(max(pixel_m * kTexels / tile_m, 1.0));
  return textureLod(u_detail, place / tile_m, max(level, finest)) * 2.0 - 1.0;
}

vec3 Chance(ivec2 cell) {  // pcg3d, as for stones
  uvec3 v = uvec3(uvec2(cell), 7u) * 1664525u + 1013904223u;
  v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
  v ^= v >> 16u;
  v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
  return vec3(v >> 8u) * (1.0 / 16777216.0);
}

// Fields of some hectares: their crop, and hedges between some of them.
vec3 Fields(vec2 place, vec4 bend, float mottle, out float hedge) {
  vec2 at = kFieldTurn * place / vec2(150.0, 95.0) + 0.10 * bend.xw;
  vec3 chance = Chance(ivec2(floor(at)));
  vec2 side = abs(fract(at) - 0.5) * 2.0;
  hedge = chance.y > 0.45 ? smoothstep(0.93, 0.96, max(side.x, side.y) + 0.02 * mottle) : 0.0;
  vec3 crop = chance.x < 0.5 ? mix(kGrass, kLush, chance.z)
                             : chance.x < 0.72 ? mix(kGrass, kHay, 0.3 + 0.5 * chance.z)
                                               : chance.x < 0.88 ? kStraw : kEarth;
  return crop * (0.9 + 0.2 * chance.z);
}

void main() {
  vec2 p = v_position_W;
  float pixel_m = sqrt(length(dFdx(p)) * length(dFdy(p)));
  vec2 beyond = max(max(u_site_low_W - p, p - u_site_high_W), vec2(0.0));
  float from_site_m = length(beyond);

  vec4 fine = Detail(p, 2.3, 0.0, pixel_m);            // blades and crumbs
  vec4 tufts = Detail(kTurn * p, 9.7, 2.0, pixel_m);   // of some decimetres
  vec4 patches = Detail(p.yx, 61.0, 3.0, pixel_m);     // of some metres
  vec4 broad = Detail(kTurn * p.yx, 700.0, 3.5, pixel_m);  // of some tens of metres

  // Soil as it is at the border, worn away to it unevenly.
  vec2 nearest = clamp(p + 1.2 * patches.yz, u_site_low_W + 0.3, u_site_high_W - 0.3);
  vec3 soil = textureLod(u_ground_albedo, (nearest - u_ground_origin) * u_ground_scale, 3.0).rgb;
  float trodden = mix(1.0, kTrodden, smoothstep(0.0, 9.0, from_site_m));
  soil *= soil * (trodden * (1.0 + 0.25 * patches.x + 0.20 * tufts.x + 0.30 * fine.x));

  float hedge;
  vec3 field = Fields(p, broad, tufts.x, hedge);
  vec3 grass = mix(kGrass, kHay, clamp(0.18 + 1.1 * patches.x + 0.5 * tufts.x, 0.0, 0.85));
  grass = mix(grass, kLush, clamp(1.6 * broad.x - 0.1, 0.0, 0.8));
  vec3 land = mix(grass, field, smoothstep(45.0, 75.0, from_site_m + 30.0 * broad.x));
  land *= 1.0 + 0.55 * tufts.x + 0.5 * fine.x + 0.22 * patches.x;
  float wooded = smoothstep(0.02, 0.10, broad.x + 0.5 * broad.w + 0.04 * tufts.x - 0.05) *
                 smoothstep(130.0, 230.0, from_site_m);
  wooded = max(wooded, smoothstep(255.0, 285.0, from_site_m + 40.0 * broad.x + 12.0 * patches.x));
  wooded = max(wooded, hedge * smoothstep(60.0, 110.0, from_site_m));
  vec4 crowns = Detail(p, 95.0, 2.0, pixel_m);
  land = mix(land, kWoods * (1.0 + 0.9 * crowns.x + 0.5 * patches.x + 0.4 * broad.x), wooded);

  // Grass comes in tufts first.
  float grows = smoothstep(1.5, 17.0, from_site_m + 9.0 * (patches.x + 0.5 * tufts.x));
  float green = smoothstep(0.35, 0.65, 1.3 * grows - 0.15 + 0.55 * tufts.x + 0.45 * fine.x);
  vec3 root = sqrt(max(mix(soil, land, green), vec3(0.004)));

  float rough = mix(0.25, 0.5, green);
  vec3 normal = normalize(v_normal_W - vec3(rough * fine.yz + 0.5 * rough * (tufts.yz * kTurn), 0.0) -
                          vec3(wooded * 0.7 * crowns.yz, 0.0));
  if (u_tone < 1.0) root *= mix(1.0, u_tone, green);  // the ground's own colour is wet already
  if (u_snow > 0.0) root = mix(root, u_snow_root, u_snow * (1.0 - 0.35 * max(patches.x, 0.0)) * (1.0 - 0.5 * wooded));
  o_albedo_roughness = vec4(min(root, vec3(1.0)), 0.95);
  o_normal_metallic = vec4(normal * 0.5 + 0.5, 0.97);
  o_label = 1u;
}
