// Dry open land in summer: dust, straw-coloured and green turf. It depends on the place only, so that a modelled piece of earth continues
// into the plain without an edge. The material's images are laid over the land by metres.
const float kLandTile_m = 1.9;

// A pixel's footprint on the land is much longer than wide. One sample from a mip level for its length would blur it
// sideways, so four samples are taken along it.
vec4 lying(sampler2D image, vec2 uv) {
#ifdef LOW
  return texture(image, uv);
#else
  vec2 broad = dFdx(uv);
  vec2 far = dFdy(uv);
  if (dot(broad, broad) > dot(far, far)) {
    vec2 other = broad;
    broad = far;
    far = other;
  }
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 4; ++i)
    sum += textureGrad(image, uv + (float(i) * 0.25 - 0.375) * far, broad, far * 0.25);
  return sum * 0.25;
#endif
}

// The land's colour and normal at distance `far_m` from the eye, without detail finer than a pixel.
vec3 land_base(sampler2D image, vec2 q, float far_m) {
  float fields = value_noise(q * 0.031 + 31.0);
  // At a grazing angle patches become streaks: smaller ones merge sooner.
  float patches = mix(value_noise(q * 0.21), 0.5, smoothstep(25.0, 120.0, far_m)) * 0.6;
  patches += mix(value_noise(q * 0.9 + 7.0), 0.5, smoothstep(5.0, 22.0, far_m)) * 0.4;
  float tufts = mix(value_noise(q * 3.7 + 3.0), 0.5, smoothstep(3.0, 12.0, far_m));
  vec3 dust = vec3(0.40, 0.31, 0.20);
  vec3 straw = vec3(0.42, 0.345, 0.165);
  vec3 green = vec3(0.155, 0.185, 0.065);
  vec3 base = mix(dust, straw, smoothstep(0.30, 0.62, patches * 0.7 + tufts * 0.3));
  base = mix(base, green, 0.8 * smoothstep(0.46, 0.74, fields * 0.45 + patches * 0.30 + tufts * 0.25));
  // The image's texture without its colour: relative to its mean, which is the smallest mip level.
  vec3 grain = lying(image, q / kLandTile_m).rgb / max(textureLod(image, vec2(0.5), 16.0).rgb, vec3(0.01));
  return base * mix(vec3(1.0), grain, 0.85 * (1.0 - smoothstep(20.0, 70.0, far_m)));
}

vec3 land_normal(sampler2D image, vec2 q, vec3 n) {
  vec2 m = lying(image, q / kLandTile_m).xy * 2.0 - 1.0;
  return normalize(n + vec3(m.x, 0.0, m.y));
}
