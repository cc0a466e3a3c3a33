uniform sampler2D u_albedo;
uniform sampler2D u_normal;
uniform sampler2D u_depth;
uniform vec3 u_to_sun_W;
uniform mat3 u_R_WC;

out vec4 o_colour;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(u_depth, pixel, 0).x;
  vec4 albedo = texelFetch(u_albedo, pixel, 0);
  vec3 normal = texelFetch(u_normal, pixel, 0).xyz * 2.0 - 1.0;
  vec3 lit = albedo.rgb * albedo.rgb * (0.3 + 1.2 * max(dot(normal, u_to_sun_W), 0.0));
  vec3 colour = depth > 0.0 ? lit : vec3(0.45, 0.6, 0.85);
  o_colour = vec4(sqrt(clamp(colour, 0.0, 1.0)), 1.0);
}
