layout(location = 0) in vec3 a_position_W;

uniform mat4 u_clip_from_relative;
uniform vec3 u_eye_W;
uniform vec2 u_ground_scale;
uniform vec2 u_ground_origin;

out vec2 v_texture;
out vec2 v_position_W;

void main() {
  gl_Position = u_clip_from_relative * vec4(a_position_W - u_eye_W, 1.0);
  v_texture = (a_position_W.xy - u_ground_origin) * u_ground_scale;
  v_position_W = a_position_W.xy;
}
