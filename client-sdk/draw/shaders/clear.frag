// Glass, horn, thin cloth: the background shines through the body's colour; the mirror image on the surface is as bright as
// on an opaque surface.
void main() {
  vec3 n;
  float opacity;
  vec3 glow;
  Surface s = material(n, opacity, glow);
  vec3 diffuse;
  vec3 mirrored;
  shade_apart(s, p_W, n, diffuse, mirrored);
  float nv = clamp(abs(dot(s.n, normalize(eye_W - p_W))), 0.0, 1.0);
  // Rough surfaces have no bright grazing reflection, or cloth would seem to have a film of glass at its edge.
  float fresnel = 0.04 + max(0.96 - s.roughness, 0.0) * pow(1.0 - nv, 5.0);
  float cover = opacity + (1.0 - opacity) * fresnel;
  vec3 light = (diffuse * opacity + mirrored) / cover;
  colour = finish(vec4(through_air(light, p_W) * cover + glow * opacity, cover));
}
