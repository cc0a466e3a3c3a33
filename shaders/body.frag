// Which body each pixel shows.

uniform int u_body;

layout(location = 0) out uint o_body;

void main() { o_body = uint(u_body); }
