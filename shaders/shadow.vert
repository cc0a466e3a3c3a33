layout(location = 0) in vec3 a_position;
layout(location = 4) in vec4 a_row0;
layout(location = 5) in vec4 a_row1;
layout(location = 6) in vec4 a_row2;

uniform mat4 u_clip_from_W;

void main() {
  vec4 p = vec4(a_position, 1.0);
  gl_Position = u_clip_from_W * vec4(dot(a_row0, p), dot(a_row1, p), dot(a_row2, p), 1.0);
}
