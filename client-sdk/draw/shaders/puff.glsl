// The light of a puff (shape below 0.5) or a drop with this normal, before its own colour. `sun`: the share that arrives.
vec3 puff_light(vec3 n, vec3 p_W, float sun, float shape) {
  // Light is scattered inside a cloud, so even its far side is not dark.
  float round = 0.45 + 0.55 * (0.5 + 0.5 * dot(n, to_sun));
  vec3 light = irradiance_from_sky(n) / kPi + sun_irradiance * sun * round * 0.5 / kPi + fire_irradiance(p_W, vec3(0.0)) / kPi;
  if (shape > 0.5) {
    vec3 v = normalize(eye_W - p_W);
    light = light * 0.55 + reflected_sky(reflect(-v, n), 0.1) * 0.45 + sun_irradiance * sun * 0.5 * pow(max(dot(reflect(-v, n), to_sun), 0.0), 24.0);
  }
  return light;
}
