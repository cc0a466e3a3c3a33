// One triangle over the whole picture, infinitely far.
out vec2 v_pixel;
uniform vec2 u_size_px;
void main() {
  vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
  gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
  v_pixel = corner * u_size_px;
}
