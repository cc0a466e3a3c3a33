layout(location = 0) in vec4 a_corner;  // of the picture, depth, share that the streak covers

flat out float v_cover;

void main() {
  gl_Position = vec4(a_corner.xyz, 1.0);
  v_cover = a_corner.w;
}
