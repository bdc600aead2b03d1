void main() {
  vec3 n;
  float opacity;
  vec3 glow;
  Surface s = material(n, opacity, glow);
  colour = finish(vec4(through_air(shade(s, p_W, n), p_W) + glow, 1.0));
}
