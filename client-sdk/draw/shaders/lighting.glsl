// Light on a surface: the sun with its shadow, the sky by spherical harmonics and mirrored by a cube map, contact shading, haze.
uniform vec3 eye_W;
uniform vec3 sun_irradiance;
uniform vec3 sh[9];
uniform samplerCube sky_cube;  // its levels are blurred for roughness, from 0 to 1
uniform float sky_on;  // 1, or 0: black
uniform mat4 X_LW;  // to the sun's frame: x and y across its rays, z along them, metres
uniform vec2 shadow_range;  // of z: where it begins, how much it is
uniform vec4 cascades[3];  // xy: middle in L, z: half width, w: texel, metres; the narrowest first
uniform int cascade_count;
uniform sampler2DArrayShadow shadow_maps;
uniform sampler2DArray shadow_depths;  // the same texture, read without comparison
uniform vec4 occluders[32];  // xyz: middle in W, w: radius
uniform int occluder_count;
uniform vec4 occluder_bound;
uniform vec4 fires[4];  // xyz: middle in W, w: irradiance at one metre
uniform int fire_count;

const float kPi = 3.14159265;
const float kSkyLevels = 4.0;  // beyond the first

struct Surface {
  vec3 base;
  float metallic;
  float roughness;
  vec3 n;  // shading normal, unit, in W
  float open;  // share of the sky that is visible from its own hollows
};

vec3 irradiance_from_sky(vec3 n) {
  return sky_on * max(vec3(0.0), sh[0] + sh[1] * n.y + sh[2] * n.z + sh[3] * n.x + sh[4] * n.x * n.y + sh[5] * n.y * n.z +
                                     sh[6] * (3.0 * n.z * n.z - 1.0) + sh[7] * n.x * n.z + sh[8] * (n.x * n.x - n.y * n.y));
}

// The tangent of the sun's angular radius (a quarter of a degree); a little more looks better.
const float kSunTangent = 0.0075;
const mat2 kGoldenTurn = mat2(-0.737369, 0.675490, -0.675490, -0.737369);

// The share of the sun that arrives, from one map. Edges are softer for farther casters (Fernando 2005). Without `asked` it
// costs nothing: even a renderer that executes both sides of every branch skips loops that are not entered.
float sunlight_of(int k, vec3 p_L, vec3 n_L, bool asked) {
  vec4 c = cascades[k];
  p_L += n_L * c.w * (1.0 + 2.5 * (1.0 - clamp(-n_L.z, 0.0, 1.0)));
  float across = 0.5 / c.z;
  vec3 q = vec3((p_L.xy - c.xy) * across + 0.5, (min(p_L.z - shadow_range.x, shadow_range.y) - 0.0015 - 0.5 * c.w) / shadow_range.y);
#ifdef LOW
  int taps = asked ? low_taps() : 0;
  float sum = 0.0;
  for (int i = 0; i < taps; ++i)
    sum += texture(shadow_maps, vec4(q.xy + low_tap(i) * (0.75 * c.w * across), float(k), q.z));
  return sum / float(max(taps, 1));
#else
  float search_m = clamp(0.05, 1.5 * c.w, 14.0 * c.w);
  float blocked = 0.0;
  float depth = 0.0;
  vec2 turn = vec2(1.0, 0.0);
  int taps = asked ? 7 : 0;
  for (int i = 0; i < taps; ++i) {
    float d = textureLod(shadow_depths, vec3(q.xy + turn * (sqrt((float(i) + 0.3) / 7.0) * search_m * across), float(k)), 0.0).r;
    float is_blocked = d < q.z ? 1.0 : 0.0;
    blocked += is_blocked;
    depth += is_blocked * d;
    turn = kGoldenTurn * turn;
  }
  // If all samples agree, the finer ones would too, as they are never wider.
  int fine = blocked > 0.5 && blocked < 6.5 ? 16 : 0;
  float soft_m = clamp(kSunTangent * (q.z - depth / max(blocked, 1.0)) * shadow_range.y, 1.3 * c.w, search_m);
  float sum = 0.0;
  for (int i = 0; i < fine; ++i) {
    sum += texture(shadow_maps, vec4(q.xy + turn * (sqrt((float(i) + 0.5) / 16.0) * soft_m * across), float(k), q.z));
    turn = kGoldenTurn * turn;
  }
  return fine > 0 ? sum / 16.0 : blocked > 0.5 ? 0.0 : 1.0;
#endif
}

// The share of the sun that arrives: from the narrowest map that reaches here, blended with the next one towards its edge.
// Beyond the widest is open land.
float sunlight(vec3 p_W, vec3 n_geometric) {
  vec3 p_L = (X_LW * vec4(p_W, 1.0)).xyz;
  vec3 n_L = mat3(X_LW) * n_geometric;
  float sum = 0.0;
  float rest = 1.0;
  for (int k = 0; k < cascade_count && rest > 0.0; ++k) {
    vec2 d = abs(p_L.xy - cascades[k].xy) / cascades[k].z;
    float share = rest * (1.0 - smoothstep(0.90, 0.99, max(d.x, d.y)));
    sum += share * sunlight_of(k, p_L, n_L, share > 0.0);
    rest -= share;
  }
#ifdef LOW
  return (sum + rest) * sun_past_movers(p_W, n_geometric);
#else
  return sum + rest;
#endif
}

// The share of the sky that small spheres leave visible, by their solid angle about the normal.
float openness(vec3 p_W, vec3 n) {
  if (occluder_count == 0 || distance(p_W, occluder_bound.xyz) > occluder_bound.w) return 1.0;
  float open = 1.0;
  for (int i = 0; i < occluder_count; ++i) {
    vec3 to = occluders[i].xyz - p_W;
    float d2 = max(dot(to, to), 1e-6);
    float r2 = occluders[i].w * occluders[i].w;
    float facing = max(dot(n, to * inversesqrt(d2)), 0.0);
    // Points inside a sphere belong to the hand, which does not shade itself.
    if (d2 > r2 * 1.02) open *= 1.0 - 0.85 * clamp(facing * r2 / d2, 0.0, 1.0);
  }
  return open;
}

// Fit of the split-sum's second factor (Lazarov 2013): scale and bias of F0.
vec2 environment_factor(float roughness, float nv) {
  vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  float a = min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y;
  return vec2(-1.04, 1.04) * a + r.zw;
}

vec3 reflected_sky(vec3 r, float roughness) { return sky_on * textureLod(sky_cube, r, roughness * kSkyLevels).rgb; }

// The light of nearby fires, without shadows; a zero normal takes light from all sides.
vec3 fire_irradiance(vec3 p_W, vec3 n) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < fire_count; ++i) {
    vec3 to = fires[i].xyz - p_W;
    float d2 = dot(to, to);
    float facing = dot(n, n) > 0.0 ? max(dot(n, to * inversesqrt(max(d2, 1e-6))), 0.0) : 0.5;
    sum += vec3(1.0, 0.44, 0.13) * fires[i].w * facing / (d2 + 0.01);
  }
  return sum;
}

// Diffuse and specular light of a surface.
void shade_apart(Surface s, vec3 p_W, vec3 n_geometric, out vec3 body, out vec3 mirrored) {
  vec3 v = normalize(eye_W - p_W);
  float nv = max(dot(s.n, v), 1e-3);
  float nl = max(dot(s.n, to_sun), 0.0);
  vec3 f0 = mix(vec3(0.04), s.base, s.metallic);
  vec3 diffuse = s.base * (1.0 - s.metallic);
  float open = openness(p_W, s.n);
  body = vec3(0.0);
  mirrored = vec3(0.0);
  if (nl > 0.0) {
    float sun = sunlight(p_W, n_geometric);
    vec3 h = normalize(v + to_sun);
    float nh = max(dot(s.n, h), 0.0);
    float a2 = s.roughness * s.roughness;
    a2 *= a2;
    float d = nh * nh * (a2 - 1.0) + 1.0;
    float ggx = a2 / (kPi * d * d);
    float visible = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));
    float away = 1.0 - max(dot(v, h), 0.0);
    float away2 = away * away;
    vec3 f = f0 + (1.0 - f0) * away2 * away2 * away;
    vec3 arriving = sun_irradiance * nl * sun * mix(1.0, open, 0.35);
    body += (1.0 - f) * diffuse / kPi * arriving;
    mirrored += ggx * visible * f * arriving;
#ifdef LOW
    from_sun = body + mirrored;
#endif
  }
  vec2 split = environment_factor(s.roughness, nv);
  // The occlusion image darkens only the sky's light; shadow maps handle the sun.
  open *= s.open;
  body += diffuse / kPi * irradiance_from_sky(s.n) * open;
  mirrored += reflected_sky(reflect(-v, s.n), s.roughness) * (f0 * split.x + split.y) * open;
  if (fire_count > 0) {
    vec3 fire = fire_irradiance(p_W, s.n) / kPi;
    body += diffuse * fire;
    mirrored += f0 * fire;
  }
}

vec3 shade(Surface s, vec3 p_W, vec3 n_geometric) {
  vec3 body;
  vec3 mirrored;
  shade_apart(s, p_W, n_geometric, body, mirrored);
  return body + mirrored;
}

// Clear nearby, and hazy beyond some hundred metres.
vec3 through_air(vec3 light, vec3 p_W) {
  float far = distance(eye_W, p_W) * 0.0030;
  float haze = sky_on * (1.0 - exp(-far * sqrt(far)));
#ifdef LOW
  from_sun *= 1.0 - haze;
#endif
  return mix(light, haze_colour(), haze);
}
