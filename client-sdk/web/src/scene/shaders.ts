// What the native display's shaders say of sky, land and air (client-sdk/draw/shaders), for three's.
import { Color, ShaderChunk, Vector3 } from 'three';

export const kToSun = new Vector3(0.58, 0.6, 0.46).normalize();
export const kSunColour = new Color().setRGB(1, 3.85 / 4.6, 2.8 / 4.6);
/** On a surface that faces the sun, W/m^2 in the sky's units. */
export const kSunIrradiance = 4.6;
export const kSunLight = new Vector3(4.6, 3.85, 2.8);
/** three divides its exposure for ACES by 0.6. */
export const kExposure = 1.15 * 0.6;
export const kHaze = new Color().setRGB(0.5, 0.6, 0.7);

export const kNoise = /* glsl */ `
float hash12(vec2 p) {
  vec3 q = fract(vec3(p.xyx) * 0.1031);
  q += dot(q, q.yzx + 33.33);
  return fract((q.x + q.y) * q.z);
}
float value_noise(vec2 p) {
  vec2 i = floor(p);
  vec2 f = fract(p);
  f = f * f * (3.0 - 2.0 * f);
  return mix(mix(hash12(i), hash12(i + vec2(1, 0)), f.x), mix(hash12(i + vec2(0, 1)), hash12(i + vec2(1, 1)), f.x), f.y);
}`;

export const kSky = /* glsl */ `
uniform vec3 to_sun;
vec3 haze_colour() { return vec3(0.50, 0.60, 0.70); }
vec3 sky_radiance(vec3 d) {
  float up = max(d.y, 0.0);
  vec3 sky = mix(vec3(0.25, 0.44, 0.74), vec3(0.075, 0.19, 0.48), smoothstep(0.10, 0.80, up));
  sky = mix(vec3(0.72, 0.76, 0.78), sky, smoothstep(-0.03, 0.22, up));
  float towards = max(dot(d, to_sun), 0.0);
  sky += vec3(0.42, 0.30, 0.16) * pow(towards, 6.0) * 0.3 + vec3(1.0, 0.82, 0.55) * pow(towards, 90.0) * 0.8;
  return mix(sky, vec3(0.23, 0.185, 0.125), smoothstep(0.0, -0.10, d.y));
}
vec3 with_clouds(vec3 sky, vec3 d) {
  if (d.y <= 0.0) return sky;
  vec2 q = d.xz / (d.y + 0.12) * vec2(0.9, 2.2);
  float cloud = value_noise(q) * 0.5 + value_noise(q * 2.3 + 4.0) * 0.3 + value_noise(q * 5.1 + 9.0) * 0.2;
  return mix(sky, vec3(1.02, 0.99, 0.95), 0.55 * smoothstep(0.48, 0.80, cloud) * smoothstep(0.02, 0.25, d.y));
}`;

/** The sky as seen: with hills, groves and the sun's disc. */
export const kSeenSky = /* glsl */ `
float hills(vec3 d, float scale, float height) {
  float a = atan(d.x, -d.z) * scale;
  return height * (0.25 + 0.60 * value_noise(vec2(a, 1.7)) + 0.30 * value_noise(vec2(a * 2.7, 5.1))
    + 0.10 * value_noise(vec2(a * 8.3, 9.4)));
}
float trees(vec3 d) {
  float a = atan(d.x, -d.z);
  float grove = smoothstep(0.46, 0.62, value_noise(vec2(a * 7.0, 21.0)));
  return grove * 0.010 * (0.35 + 0.65 * value_noise(vec2(a * 170.0, 3.3))) - 0.002;
}
vec3 seen_sky(vec3 d) {
  vec3 sky = with_clouds(sky_radiance(d), d);
  float elevation = d.y / max(length(d.xz), 1e-4);
  float soft = max(fwidth(elevation), 1e-5);
  sky = mix(sky, mix(vec3(0.16, 0.21, 0.25), haze_colour(), 0.72), smoothstep(soft, -soft, elevation - hills(d, 5.0, 0.062)));
  sky = mix(sky, mix(vec3(0.15, 0.16, 0.09), haze_colour(), 0.52), smoothstep(soft, -soft, elevation - hills(d, 9.0, 0.026)));
  sky = mix(sky, mix(vec3(0.075, 0.095, 0.045), haze_colour(), 0.42), smoothstep(soft, -soft, elevation - trees(d)));
  return sky + smoothstep(0.99985, 0.99995, dot(d, to_sun)) * vec3(12.0, 10.5, 8.0);
}`;

/** Dry open land in summer, by place; mean: of the image, so that only its grain counts. */
export const kLand = /* glsl */ `
uniform sampler2D land_image;
uniform sampler2D land_normals;
uniform float plain_height;
vec3 land_base(vec2 q, float away) {
  float fields = value_noise(q * 0.031 + 31.0);
  float patches = mix(value_noise(q * 0.21), 0.5, smoothstep(25.0, 120.0, away)) * 0.6;
  patches += mix(value_noise(q * 0.9 + 7.0), 0.5, smoothstep(5.0, 22.0, away)) * 0.4;
  float tufts = mix(value_noise(q * 3.7 + 3.0), 0.5, smoothstep(3.0, 12.0, away));
  vec3 base = mix(vec3(0.40, 0.31, 0.20), vec3(0.42, 0.345, 0.165), smoothstep(0.30, 0.62, patches * 0.7 + tufts * 0.3));
  base = mix(base, vec3(0.155, 0.185, 0.065), 0.8 * smoothstep(0.46, 0.74, fields * 0.45 + patches * 0.30 + tufts * 0.25));
  vec3 grain = texture2D(land_image, q / 1.9).rgb / max(textureLod(land_image, vec2(0.5), 16.0).rgb, vec3(0.01));
  return base * mix(vec3(1.0), grain, 0.85 * (1.0 - smoothstep(20.0, 70.0, away)));
}`;

/** Haze before the tone curve, as the native display has it; three mixes its fog in after it. */
const kAir = /* glsl */ `
#include <air_original>
#ifdef USE_FOG
  float air_far = vFogDepth * 0.0030;
  gl_FragColor.rgb = mix(gl_FragColor.rgb, fogColor, 1.0 - exp(-air_far * sqrt(air_far)));
#endif`;

let changed = false;
/** Once, before the first material is compiled. */
export function useNativeAir(): void {
  if (changed) return;
  changed = true;
  const chunks = ShaderChunk as Record<string, string>;
  chunks.air_original = chunks.opaque_fragment!;
  chunks.opaque_fragment = kAir;
  chunks.fog_fragment = '';
}
