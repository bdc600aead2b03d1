in vec2 uv;
in vec4 tint;
in vec4 shape;
out vec4 colour;
uniform sampler2D atlas;
void main() {
  float cover;
  if (shape.w > 0.5) {
    vec2 q = abs(uv) - shape.xy + shape.z;
    float d = length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - shape.z;
    cover = clamp(0.5 - d, 0.0, 1.0);
  } else {
    cover = texture(atlas, uv).r;
  }
  colour = vec4(tint.rgb, tint.a * cover);
}
