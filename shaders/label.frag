in vec3 v_relative_W;
in vec3 v_normal_W;
flat in uint v_label;

layout(location = 0) out uint o_label;
layout(location = 1) out vec4 o_normal;

void main() {
  vec3 normal = normalize(v_normal_W);
  normal = dot(normal, v_relative_W) > 0.0 ? -normal : normal;
  o_label = v_label;
  o_normal = vec4(normal * 0.5 + 0.5, 0.0);
}
