layout(location = 0) in vec3 a_position_W;
layout(location = 1) in vec3 a_normal_W;

uniform mat4 u_clip_from_relative;
uniform vec3 u_eye_W;

out vec2 v_position_W;
out vec3 v_normal_W;

void main() {
  gl_Position = u_clip_from_relative * vec4(a_position_W - u_eye_W, 1.0);
  v_position_W = a_position_W.xy;
  v_normal_W = a_normal_W;
}
