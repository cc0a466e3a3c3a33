layout(location = 0) in vec3 a_position;
layout(location = 1) in vec4 a_normal;
layout(location = 2) in vec4 a_albedo_opacity;
layout(location = 3) in vec4 a_roughness_metallic;
layout(location = 4) in vec4 a_row0;
layout(location = 5) in vec4 a_row1;
layout(location = 6) in vec4 a_row2;
layout(location = 7) in uint a_label;
layout(location = 8) in vec2 a_uv;

uniform mat4 u_clip_from_relative;
#ifdef WORN
uniform mat4 u_body_from_mesh;
out vec3 v_place_B;
out vec3 v_normal_B;
#endif

out vec3 v_relative_W;
out vec3 v_normal_W;
out vec2 v_uv;
flat out vec4 v_albedo_opacity;
flat out vec4 v_roughness_metallic;
flat out uint v_label;

invariant gl_Position;  // two programs draw the same triangles, the second where depths are equal

void main() {
  vec4 p = vec4(a_position, 1.0);
  v_relative_W = vec3(dot(a_row0, p), dot(a_row1, p), dot(a_row2, p));
  gl_Position = u_clip_from_relative * vec4(v_relative_W, 1.0);
  v_normal_W = vec3(dot(a_row0.xyz, a_normal.xyz), dot(a_row1.xyz, a_normal.xyz),
                    dot(a_row2.xyz, a_normal.xyz));
  v_albedo_opacity = a_albedo_opacity;
  v_roughness_metallic = a_roughness_metallic;
  v_label = a_label;
  v_uv = a_uv;
#ifdef WORN
  v_place_B = (u_body_from_mesh * p).xyz;
  v_normal_B = mat3(u_body_from_mesh) * a_normal.xyz;
#endif
}
