// A clear afternoon over dry land: radiance from direction d (unit), without the sun's disc.
uniform vec3 to_sun;

vec3 haze_colour() { return vec3(0.50, 0.60, 0.70); }

vec3 sky_radiance(vec3 d) {
  float up = max(d.y, 0.0);
  vec3 zenith = vec3(0.075, 0.19, 0.48);
  vec3 middle = vec3(0.25, 0.44, 0.74);
  vec3 low = vec3(0.72, 0.76, 0.78);
  vec3 sky = mix(middle, zenith, smoothstep(0.10, 0.80, up));
  sky = mix(low, sky, smoothstep(-0.03, 0.22, up));
  float towards = max(dot(d, to_sun), 0.0);
  sky += vec3(0.42, 0.30, 0.16) * pow(towards, 6.0) * 0.3 + vec3(1.0, 0.82, 0.55) * pow(towards, 90.0) * 0.8;
  vec3 earth = vec3(0.23, 0.185, 0.125);
  return mix(sky, earth, smoothstep(0.0, -0.10, d.y));
}
