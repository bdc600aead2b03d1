// Materials that glTF does not have: sky, land, water, falling water.
import {
  BackSide,
  Color,
  DataTexture,
  DoubleSide,
  MeshStandardMaterial,
  RepeatWrapping,
  ShaderMaterial,
  type Texture,
  UniformsLib,
  UniformsUtils,
  Vector2,
} from 'three';
import { kLand, kNoise, kSeenSky, kSky, kSunLight, kToSun } from './shaders';

const kEnd = /* glsl */ `
#include <tonemapping_fragment>
#include <colorspace_fragment>`;
const kVertexInW = /* glsl */ `
varying vec3 p_W;
varying vec3 n_W;
varying vec2 place;
#include <fog_pars_vertex>
void main() {
  vec4 at = modelMatrix * vec4(position, 1.0);
  p_W = at.xyz;
  n_W = mat3(modelMatrix) * normal;
  place = uv;
  vec4 mvPosition = viewMatrix * at;
  gl_Position = projectionMatrix * mvPosition;
  #include <fog_vertex>
}`;

/** The whole sky; without its hills and the sun's disc for light. */
export function skyMaterial(seen: boolean): ShaderMaterial {
  return new ShaderMaterial({
    side: BackSide,
    depthWrite: false,
    depthTest: false,
    fog: false,
    uniforms: { to_sun: { value: kToSun } },
    vertexShader: /* glsl */ `
varying vec3 d_W;
void main() {
  d_W = position;
  gl_Position = projectionMatrix * mat4(mat3(viewMatrix)) * vec4(position, 1.0);
}`,
    fragmentShader: `varying vec3 d_W;\n${kNoise}${kSky}${kSeenSky}
void main() {
  vec3 d = normalize(d_W);
  gl_FragColor = vec4(${seen ? 'seen_sky(d)' : 'with_clouds(sky_radiance(d), d)'}, 1.0);
  ${kEnd}
}`,
  });
}

function onePixel(r: number, g: number, b: number): DataTexture {
  const texture = new DataTexture(new Uint8Array([r, g, b, 255]), 1, 1);
  texture.needsUpdate = true;
  return texture;
}

/** Earth that continues into the plain: its colour depends on the place alone. */
export function landMaterial(image: Texture | null, normals: Texture | null, plainHeight: { value: number }): MeshStandardMaterial {
  const material = new MeshStandardMaterial({ roughness: 0.95, metalness: 0, side: DoubleSide });
  const uniforms = {
    land_image: { value: image ?? onePixel(200, 200, 200) },
    land_normals: { value: normals ?? onePixel(128, 128, 255) },
    plain_height: plainHeight,
  };
  for (const { value } of [uniforms.land_image, uniforms.land_normals]) {
    value.wrapS = RepeatWrapping;
    value.wrapT = RepeatWrapping;
    value.anisotropy = 4;
  }
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', '#include <common>\nvarying vec3 land_p;\nvarying vec3 land_n;')
      .replace(
        '#include <project_vertex>',
        '#include <project_vertex>\nland_p = (modelMatrix * vec4(transformed, 1.0)).xyz;\nland_n = mat3(modelMatrix) * objectNormal;',
      );
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', `#include <common>\nvarying vec3 land_p;\nvarying vec3 land_n;\n${kNoise}${kLand}`)
      .replace(
        '#include <map_fragment>',
        /* glsl */ `
  vec3 land_up = normalize(land_n);
  if (!gl_FrontFacing) land_up = -land_up;
  vec2 land_q = land_p.xz;
  // The cut side of a piece of land looks as if the land continued over it.
  if (abs(land_up.y) < 0.35) {
    land_q -= land_p.y * land_up.xz;
    land_up = vec3(0.0, 1.0, 0.0);
  }
  diffuseColor.rgb = land_base(land_q, length(vViewPosition));`,
      )
      .replace(
        '#include <normal_fragment_maps>',
        /* glsl */ `
  land_up = normalize(mix(land_up, vec3(0.0, 1.0, 0.0), 1.0 - smoothstep(0.02, 0.12, abs(land_p.y - plain_height))));
  vec2 land_m = texture2D(land_normals, land_q / 1.9).xy * 2.0 - 1.0;
  normal = normalize((viewMatrix * vec4(normalize(land_up + vec3(land_m.x, 0.0, land_m.y)), 0.0)).xyz);`,
      );
  };
  material.customProgramCacheKey = () => 'land';
  return material;
}

export interface WaterLook {
  /** 0 deep and muddy .. 1 a thin clear sheet. */
  clearness: number;
  ripple: number;
  /** Along x and z, m/s. */
  flow: Vector2;
  /** Over 0: uv's x is the share of the way across, and the sides end softly. */
  width: number;
}

/** Water from above: the sky mirrored by Fresnel over a body of its own colour. */
export function waterMaterial(look: WaterLook, time: { value: number }): ShaderMaterial {
  const material = new ShaderMaterial({
    transparent: true,
    side: DoubleSide,
    depthWrite: false,
    fog: true,
    uniforms: UniformsUtils.merge([
      UniformsLib.fog,
      {
        clearness: { value: look.clearness },
        ripple: { value: look.ripple },
        flow: { value: look.flow },
        width_m: { value: look.width },
        to_sun: { value: kToSun },
        sun_light: { value: kSunLight },
      },
    ]),
    vertexShader: kVertexInW,
    fragmentShader: /* glsl */ `
varying vec3 p_W;
varying vec3 n_W;
varying vec2 place;
uniform float time_s;
uniform float clearness;
uniform float ripple;
uniform vec2 flow;
uniform float width_m;
uniform vec3 sun_light;
#include <fog_pars_fragment>
${kNoise}${kSky}
vec2 waves(vec2 q) {
  vec2 sum = vec2(0.0);
  float strength = 0.050;
  float length_m = 0.85;
  float a = 0.4;
  for (int i = 0; i < 4; ++i) {
    vec2 d = vec2(cos(a), sin(a));
    float k = 6.2831853 / length_m;
    sum += d * cos(k * dot(d, q) - sqrt(9.81 * k) * time_s) * strength;
    a += 2.2;
    length_m *= 0.62;
    strength *= 0.78;
  }
  return sum;
}
vec2 unrest(vec2 q, vec2 along, float speed) {
  vec2 across = vec2(-along.y, along.x);
  vec2 sum = vec2(0.0);
  float size = 1.3;
  float share = 1.0;
  for (int k = 0; k < 2; ++k) {
    vec2 p = vec2(dot(q, along) - speed * share * time_s, 2.4 * dot(q, across)) * size + 17.0 * float(k);
    float h = value_noise(p);
    sum += along * (value_noise(p + vec2(0.25, 0.0)) - h) + 1.6 * across * (value_noise(p + vec2(0.0, 0.25)) - h);
    size *= 2.3;
    share *= 0.86;
  }
  return 0.15 * sum;
}
void main() {
  vec3 away = cameraPosition - p_W;
  vec3 v = normalize(away);
  vec3 flat_n = normalize(n_W);
  if (!gl_FrontFacing) flat_n = -flat_n;
  vec3 n = flat_n;
  float speed = length(flow);
  if (abs(flat_n.y) > 0.5) {
    vec2 sl = speed > 0.0 ? 0.55 * waves(p_W.xz - flow * time_s) + unrest(p_W.xz, flow / speed, speed) : waves(p_W.xz);
    sl *= ripple / (1.0 + 0.012 * dot(away, away));
    n = normalize(flat_n - vec3(sl.x, 0.0, sl.y));
  }
  float nv = clamp(dot(n, v), 0.02, 1.0);
  vec3 r = reflect(-v, n);
  r.y = abs(r.y);
  float side = width_m > 0.0 ? smoothstep(0.0, 0.5, min(place.x, 1.0 - place.x) * width_m + 0.4 * (value_noise(p_W.xz * 0.9) - 0.5)) : 1.0;
  float fresnel = (0.02 + 0.98 * pow(1.0 - nv, 5.0)) * side;
  float cover = mix(0.92, 0.45, clearness) * side;
  float glint = pow(max(dot(r, to_sun), 0.0), 420.0) * 30.0;
  vec3 body = vec3(0.022, 0.050, 0.042) * (vec3(0.26, 0.34, 0.46) * 1.6 + sun_light * 0.22);
  vec3 light = body * cover + sky_radiance(r) * fresnel + vec3(1.0, 0.9, 0.75) * glint * fresnel * 6.0;
  float opacity = clamp(cover + fresnel, 0.0, 1.0);
  light /= max(opacity, 1e-3);
  #ifdef USE_FOG
    float far = vFogDepth * 0.0030;
    light = mix(light, haze_colour(), 1.0 - exp(-far * sqrt(far)));
  #endif
  gl_FragColor = vec4(light, opacity);
  ${kEnd}
}`,
  });
  material.uniforms.time_s = time;  // after the merge, which copies: all waters share it
  return material;
}

/** Falling water: bright streaks that run along the fall. uv: about the stream, seconds since it left. */
export function streamMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    transparent: true,
    side: DoubleSide,
    depthWrite: false,
    fog: false,
    uniforms: { to_sun: { value: kToSun }, time_s: { value: 0 }, broken_s: { value: 1 }, lumps_per_s: { value: 8 } },
    vertexShader: /* glsl */ `
varying vec3 p_W;
varying vec3 n_W;
varying vec2 place;
void main() {
  p_W = position;
  n_W = normal;
  place = uv;
  gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
}`,
    fragmentShader: /* glsl */ `
varying vec3 p_W;
varying vec3 n_W;
varying vec2 place;
uniform float time_s;
uniform float broken_s;
uniform float lumps_per_s;
${kNoise}${kSky}
void main() {
  vec3 v = normalize(cameraPosition - p_W);
  vec3 n = normalize(n_W);
  if (!gl_FrontFacing) n = -n;
  float streak = 0.6 * value_noise(vec2(place.x * 14.0, (place.y - time_s) * 16.0));
  streak += 0.4 * value_noise(vec2(place.x * 31.0, (place.y - time_s) * 37.0));
  float fresnel = 0.03 + 0.97 * pow(1.0 - clamp(dot(n, v), 0.0, 1.0), 4.0);
  vec3 white = vec3(0.62, 0.68, 0.76) * (0.7 + 0.3 * max(dot(n, to_sun), 0.0));
  vec3 light = white * (0.25 + 0.75 * smoothstep(0.35, 0.8, streak)) + sky_radiance(reflect(-v, n)) * fresnel;
  float opacity = clamp(0.22 + 0.55 * smoothstep(0.3, 0.85, streak) + fresnel * 0.6, 0.0, 0.95);
  float gone = mix(-0.2, 1.2, smoothstep(0.55, 1.5, place.y / broken_s));
  if (gone > 0.0) {
    float lump = value_noise(vec2(place.x * 2.0, (place.y - time_s) * lumps_per_s));
    opacity *= smoothstep(gone - 0.18, gone + 0.18, lump);
  }
  gl_FragColor = vec4(light, opacity);
  ${kEnd}
}`,
  });
}

export function plain(r: number, g: number, b: number, roughness: number): MeshStandardMaterial {
  return new MeshStandardMaterial({ color: new Color().setRGB(r, g, b), roughness, metalness: 0 });
}
