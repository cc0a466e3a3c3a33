// Daylight as the shading passes use it. All radiances and the sun's illuminance are multiplied by
// the exposure, so that 1 is the brightest that the picture holds before the tone curve.

const float kPi = 3.14159265;
const vec3 kLuminous = vec3(0.2126, 0.7152, 0.0722);  // of linear sRGB

uniform vec3 u_to_sun_W;
uniform vec3 u_sun;            // illuminance facing the sun
uniform vec3 u_diffuse[9];     // sky irradiance over pi, polynomial in the normal
uniform vec3 u_airlight[3];    // polynomial in the cosine of the azimuth from the sun
uniform vec3 u_zenith;
uniform vec3 u_bounce;         // radiance of the ground around
uniform float u_extinction_1pm;

vec3 SkyDiffuse(vec3 n) {
  vec3 c = u_diffuse[0] + u_diffuse[1] * n.y + u_diffuse[2] * n.z + u_diffuse[3] * n.x +
           u_diffuse[4] * (n.x * n.y) + u_diffuse[5] * (n.y * n.z) +
           u_diffuse[6] * (3.0 * n.z * n.z - 1.0) + u_diffuse[7] * (n.x * n.z) +
           u_diffuse[8] * (n.x * n.x - n.y * n.y);
  return max(c, vec3(0.0));
}

vec3 Airlight(vec3 direction) {
  vec2 h = direction.xy, s = u_to_sun_W.xy;
  float c = dot(h, s) * inversesqrt(max(dot(h, h) * dot(s, s), 1e-9));
  return max(u_airlight[0] + c * (u_airlight[1] + c * u_airlight[2]), vec3(0.0));
}

// What a mirror in the open sees, blurred by roughness: ground below, airlight, zenith above.
vec3 Reflected(vec3 direction, float roughness) {
  float blur = 0.03 + roughness * 0.9;
  vec3 sky = mix(Airlight(direction), u_zenith, sqrt(clamp(direction.z, 0.0, 1.0)));
  return mix(u_bounce, sky, smoothstep(-blur, blur, direction.z));
}

// Koschmieder: contrast falls as exp(-extinction range).
vec3 Fog(vec3 radiance, vec3 direction, float range_m) {
  return mix(Airlight(direction), radiance, exp(-u_extinction_1pm * range_m));
}

// Cook-Torrance with GGX and the Smith term of Karis 2013, times cos(theta).
float Specular(float n_l, float n_v, float n_h, float roughness) {
  float a = roughness * roughness, a2 = a * a;
  float d = n_h * n_h * (a2 - 1.0) + 1.0;
  float k = (roughness + 1.0) * (roughness + 1.0) * 0.125;
  float smith = (n_l * (1.0 - k) + k) * (n_v * (1.0 - k) + k);
  return a2 * n_l / (kPi * d * d * 4.0 * smith + 1e-6);
}

float FresnelPower(float cosine) {
  float m = 1.0 - clamp(cosine, 0.0, 1.0);
  return m * m * m * m * m;
}
