// Thin high clouds, stretched by the wind, in direction d (unit). The visible sky also lights the land: without clouds its
// light, and so each shadow, would be much bluer than measured.
vec3 with_clouds(vec3 sky, vec3 d) {
  if (d.y <= 0.0) return sky;
  vec2 q = d.xz / (d.y + 0.12) * vec2(0.9, 2.2);
  float cloud = value_noise(q) * 0.5 + value_noise(q * 2.3 + 4.0) * 0.3 + value_noise(q * 5.1 + 9.0) * 0.2;
  return mix(sky, vec3(1.02, 0.99, 0.95), 0.55 * smoothstep(0.48, 0.80, cloud) * smoothstep(0.02, 0.25, d.y));
}
