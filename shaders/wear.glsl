// Dust, mud, scratches and rust of a surface. Places are in the frame of the body, in metres; colours are square roots
// of the albedo.

in vec3 v_place_B;
in vec3 v_normal_B;

uniform vec4 u_wear;  // dust, mud, scratches, rust
uniform vec3 u_dust_root;
uniform vec3 u_mud_root;
uniform vec4 u_from_soil;  // metres from the soil: normal and offset
uniform vec2 u_edge;       // (x, z) of a cutting edge
uniform vec3 u_place_in_noise;
uniform sampler3D u_wear_noise;  // coarse and fine, both of mean 1/2 and deviation 0.2

struct Surface {
  vec3 root_albedo;
  float roughness, metallic;
};

// Turned, so that the noise's lattice lies along no side of a part.
const mat3 kAskew = mat3(0.7071, 0.5, -0.5, -0.0, 0.7071, 0.7071, 0.7071, -0.5, 0.5);

vec2 WearNoise(float scale_1pm) {
  return texture(u_wear_noise, (kAskew * v_place_B) * scale_1pm + u_place_in_noise).rg;
}

vec2 Streaks(vec3 scale_1pm, mat3 turn) {
  return texture(u_wear_noise, (turn * v_place_B) * scale_1pm + u_place_in_noise.yzx).rg;
}

void Cover(inout Surface s, vec3 root_albedo, float roughness, float metallic, float share) {
  s.root_albedo = mix(s.root_albedo, root_albedo, share);
  s.roughness = mix(s.roughness, roughness, share);
  s.metallic = mix(s.metallic, metallic, share);
}

const vec3 kSteelRoot = vec3(0.62, 0.60, 0.58), kPrimerRoot = vec3(0.30, 0.27, 0.26);
const vec3 kFreshRust = vec3(0.52, 0.27, 0.14), kOldRust = vec3(0.32, 0.19, 0.13);

// `patches` has lumps of half a metre and less, `grain` of some centimetres.
void Worn(inout Surface s, vec2 patches, vec2 grain) {
  float from_soil_m = max(dot(u_from_soil.xyz, v_place_B) + u_from_soil.w, 0.0);
  float scratches = u_wear.z, rust = u_wear.w;
  float from_edge_m = length(v_place_B.xz - u_edge);
  // Paint is smooth; rubber, wood and concrete are not.
  float painted = 1.0 - smoothstep(0.60, 0.75, s.roughness);
  float exposed = 0.30 + 0.7 * exp(-from_soil_m * 1.4) + 1.2 * exp(-from_edge_m * from_edge_m * 9.0);
  float hit = painted * clamp(scratches * exposed, 0.0, 1.0);
  // Scrapes run along the body or up and down it; chips lie about in the grain.
  const mat3 kDown = mat3(0.94, 0.10, -0.33, -0.13, 0.99, -0.05, 0.32, 0.09, 0.94);
  float along = Streaks(vec3(0.9, 15.0, 15.0), kDown).g, up = Streaks(vec3(13.0, 11.0, 1.1), kDown).g;
  vec2 small = WearNoise(5.6);
  float cluster = smoothstep(0.42, 0.75, 0.5 * patches.g + 0.5 * grain.r);  // blows come in one place
  float chip = smoothstep(0.0, 0.10, hit * (0.25 + 0.95 * cluster) - 1.5 * (0.92 - small.g));
  float scrape = smoothstep(0.0, 0.14, hit * (0.15 + cluster) - 1.5 * (0.93 - max(along, up - 0.12)));
  float bare = max(0.75 * scrape, chip);
  float rusted = rust * smoothstep(0.35, 0.65, grain.r * 0.6 + patches.g * 0.6);
  float halo = smoothstep(0.0, 0.35, hit * (0.25 + 0.95 * cluster) - 1.5 * (0.80 - small.g));
  halo *= rust * (1.0 - s.metallic);
  Cover(s, mix(s.root_albedo, kFreshRust, 0.55), 0.75, 0.0, 0.8 * halo);
  vec3 steel = mix(kPrimerRoot, kSteelRoot, smoothstep(0.4, 0.7, grain.r));
  Cover(s, mix(steel, kOldRust, rusted), mix(0.45, 0.9, rusted), 0.5 * (1.0 - rusted), bare);
  // Steel that was never painted rusts as well, unless it slides.
  float steel_bare = smoothstep(0.5, 0.7, s.metallic) * rust * smoothstep(0.45, 0.62, patches.r);
  Cover(s, mix(kOldRust, kFreshRust, grain.r), 0.9, 0.0, steel_bare * (1.0 - 0.5 * bare));
}

void Rubbed(inout Surface s, vec2 grain, out float rubbed) {
  float from_edge_m = length(v_place_B.xz - u_edge);
  float reach_m = 0.05 + 0.10 * u_wear.z + 0.10 * (grain.r - 0.5);
  rubbed = min(1.0, 3.0 * u_wear.z) * (1.0 - smoothstep(0.6 * reach_m, reach_m + 0.03, from_edge_m));
  Cover(s, kSteelRoot * (0.85 + 0.3 * grain.g), 0.38, 0.75, rubbed);
}

void Soiled(inout Surface s, vec2 patches, vec2 grain, float rubbed) {
  float dust = u_wear.x, mud = u_wear.y;
  float from_soil_m = max(dot(u_from_soil.xyz, v_place_B) + u_from_soil.w, 0.0);
  float up = smoothstep(0.25, 0.95, normalize(v_normal_B).z);
  // Rain has washed upright faces in streaks.
  float streak = Streaks(vec3(2.3, 2.3, 0.25), mat3(1.0)).g;
  float film = 0.16 + 0.34 * exp(-from_soil_m * 1.3);
  film *= 0.35 + 1.3 * smoothstep(0.25, 0.75, 0.6 * streak + 0.4 * patches.r);
  float lies = 0.85 * up * (0.55 + 0.9 * patches.r);
  float hidden = clamp(dust * (film + lies) + 0.10 * dust * (grain.r - 0.5), 0.0, 0.92);
  Cover(s, u_dust_root * (0.94 + 0.12 * grain.r), 0.95, 0.0, hidden);

  float reach_m = 0.08 + 0.75 * mud;
  float near = exp(-from_soil_m / reach_m);
  float down = 1.0 - 0.25 * up;
  float uneven = 0.9 * (patches.r - 0.5) + 0.7 * (grain.r - 0.5) + 0.35 * (grain.g - 0.5);
  float thick = (0.20 + 1.05 * mud) * near * down - 0.5 + uneven * (0.25 + 0.75 * near);
  float caked = smoothstep(-0.10, 0.08, thick) * min(1.0, 20.0 * mud);
  // Splashes dry to the colour of dust, and thin out further up to single spots.
  float some = smoothstep(0.0, 0.25, mud);
  float splash = some * near * (0.35 + 0.45 * mud + 0.8 * (grain.r - 0.5) + 0.5 * (grain.g - 0.5));
  float spots = some * smoothstep(0.80, 0.86, grain.g + 0.22 * sqrt(near) - 0.06) * smoothstep(0.05, 0.3, near);
  splash = max(splash, 0.85 * spots);
  Cover(s, mix(u_dust_root, u_mud_root, 0.35), 0.92, 0.0, clamp(splash, 0.0, 0.8) * (1.0 - 0.7 * rubbed));
  float fresh = smoothstep(0.02, 0.40, thick + 0.3 * (grain.g - 0.5));
  vec3 root = mix(mix(u_dust_root, u_mud_root, 0.55), u_mud_root, fresh) * (0.86 + 0.28 * grain.g);
  Cover(s, root, 0.93, 0.0, caked * (1.0 - 0.8 * rubbed));
}

Surface Aged(Surface s) {
  if (s.metallic > 0.9 && s.roughness < 0.25) return s;  // rods and mirrors are wiped
  vec2 patches = WearNoise(0.41), grain = WearNoise(1.9);
  if (u_wear.z > 0.0 || u_wear.w > 0.0) Worn(s, patches, grain);
  float rubbed = 0.0;
  if (u_wear.z > 0.0) Rubbed(s, grain, rubbed);
  if (u_wear.x > 0.0 || u_wear.y > 0.0) Soiled(s, patches, grain, rubbed);
  return s;
}
