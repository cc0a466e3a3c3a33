// The dust of a picture of half the size, for each pixel that of the samples around which are about
// as deep: an edge before a plume stays sharp.

uniform sampler2D u_depth;
uniform sampler2D u_light;

out vec4 o_light;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 last = textureSize(u_depth, 0) - 1, last_half = textureSize(u_light, 0) - 1;
  float depth = texelFetch(u_depth, pixel, 0).x;
  ivec2 corner = pixel / 2;
  vec2 f = 0.5 * vec2(pixel - 2 * corner);
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int k = 0; k < 4; ++k) {
    ivec2 offset = ivec2(k & 1, k >> 1);
    ivec2 sample_at = min(corner + offset, last_half);
    float there = texelFetch(u_depth, min(2 * sample_at, last), 0).x;
    vec2 near = mix(1.0 - f, f, vec2(offset));
    float apart = abs(there - depth) / (max(there, depth) + 1e-9);
    float weight = (near.x * near.y + 1e-4) / (1e-3 + apart);
    sum += weight * texelFetch(u_light, sample_at, 0);
    weights += weight;
  }
  o_light = sum / weights;
}
