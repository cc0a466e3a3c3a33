flat in uint v_label;

layout(location = 0) out uint o_label;

void main() { o_label = v_label; }
