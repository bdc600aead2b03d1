// Thin high cloud, drawn out by the wind, before the sky in direction d (unit). What is seen and what lights the land are the same sky: without its
// clouds the sky's light would be far bluer than measured, and so would each shadow.
vec3 with_clouds(vec3 sky, vec3 d) {
  if (d.y <= 0.0) return sky;
  vec2 q = d.xz / (d.y + 0.12) * vec2(0.9, 2.2);
  float cloud = value_noise(q) * 0.5 + value_noise(q * 2.3 + 4.0) * 0.3 + value_noise(q * 5.1 + 9.0) * 0.2;
  return mix(sky, vec3(1.02, 0.99, 0.95), 0.55 * smoothstep(0.48, 0.80, cloud) * smoothstep(0.02, 0.25, d.y));
}
