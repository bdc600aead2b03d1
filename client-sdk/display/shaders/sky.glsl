// A clear afternoon over dry country: radiance from direction d (unit), without the sun's disc.
uniform vec3 to_sun;

vec3 haze_colour() { return vec3(0.86, 0.82, 0.74); }

vec3 sky_radiance(vec3 d) {
  float up = max(d.y, 0.0);
  vec3 zenith = vec3(0.13, 0.29, 0.62);
  vec3 middle = vec3(0.42, 0.60, 0.84);
  vec3 sky = mix(middle, zenith, smoothstep(0.05, 0.75, up));
  sky = mix(haze_colour(), sky, smoothstep(-0.02, 0.26, up));
  float towards = max(dot(d, to_sun), 0.0);
  sky += vec3(0.42, 0.30, 0.16) * pow(towards, 6.0) * 0.35 + vec3(1.0, 0.82, 0.55) * pow(towards, 90.0) * 0.8;
  vec3 earth = vec3(0.30, 0.25, 0.18);
  return mix(sky, earth, smoothstep(0.0, -0.10, d.y));
}
