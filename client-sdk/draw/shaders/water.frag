// Water from above: the surroundings or the sky, mirrored by Fresnel, over a body through which the bottom is visible. Ripples
// move with the world's time, and a river carries them along.
in vec3 p_W;
in vec3 n_W;
in vec4 t_W;
in vec2 uv;
out vec4 colour;

uniform mat4 PV;
uniform float time_s;
uniform float clearness;
uniform float ripple;
uniform vec2 flow;  // along x and z, m/s; none: it stands
uniform float width_m;  // over 0: uv's x is the share of the way across, and the sides end softly
uniform sampler2D depth;  // of all that is solid
uniform vec2 depth_to_m;  // of clip space: distance before the eye = y / (x + depth)
uniform sampler2D mirror;  // the surroundings as mirrored by still water; opacity 0: nothing was drawn
uniform bool mirrors;

#ifdef LOW
const int kWaves = 3;
const int kLayers = 2;
#else
const int kWaves = 5;
const int kLayers = 3;
#endif
// The distance to the mirrored thing: the nearer it is, the less a ripple shifts it.
const float kMirrored_m = 0.8;

// Waves in different directions, relative to the water.
vec2 waves(vec2 q) {
  vec2 sum = vec2(0.0);
  float strength = 0.050;
  float length_m = 0.85;
  float a = 0.4;
  for (int i = 0; i < kWaves; ++i) {
    vec2 d = vec2(cos(a), sin(a));
    float k = 6.2831853 / length_m;
    sum += d * cos(k * dot(d, q) - sqrt(9.81 * k) * time_s) * strength;
    a += 2.2;
    length_m *= 0.62;
    strength *= 0.78;
  }
  return sum;
}

// A river's turbulence, stretched along its flow: layers that move relative to each other, so that no pattern repeats.
vec2 unrest(vec2 q, vec2 along, float speed) {
  vec2 across = vec2(-along.y, along.x);
  vec2 sum = vec2(0.0);
  float size = 1.3;
  float share = 1.0;
  for (int k = 0; k < kLayers; ++k) {
    vec2 p = vec2(dot(q, along) - speed * share * time_s, 2.4 * dot(q, across)) * size + 17.0 * float(k);
    float h = value_noise(p);
    sum += along * (value_noise(p + vec2(0.25, 0.0)) - h) + 1.6 * across * (value_noise(p + vec2(0.0, 0.25)) - h);
    size *= 2.3;
    share *= 0.86;
  }
  return 0.15 * sum;
}

vec2 slope(vec2 q, float speed) {
  if (speed <= 0.0) return waves(q) * ripple;
  vec2 along = flow / speed;
  // Slicks: bands along the current that lie calmer.
  float calm = value_noise(vec2(0.25 * (dot(q, along) - speed * time_s), 1.7 * dot(q, vec2(-along.y, along.x))));
  return (0.55 * waves(q - flow * time_s) + unrest(q, along, speed)) * ripple * mix(0.45, 1.25, calm);
}

// Metres of water above the bottom; unknown where something is in front of it.
float depth_of_water(vec3 n) {
  float here = 1.0 / gl_FragCoord.w;
  float solid = depth_to_m.y / (depth_to_m.x + 2.0 * texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r - 1.0);
  return solid < 0.9995 * here ? 1.0 : (solid / here - 1.0) * abs(dot(n, eye_W - p_W));
}

vec3 mirrored_about(vec3 r) {
  vec3 sky = reflected_sky(r, 0.05);
#ifdef LOW
  return sky;
#else
  if (!mirrors) return sky;
  vec3 q = p_W + r * kMirrored_m;
  q.y = 2.0 * p_W.y - q.y;
  vec4 clip = PV * vec4(q, 1.0);
  vec4 seen = texture(mirror, clip.xy / clip.w * 0.5 + 0.5);
  // Beyond the water's edge nothing was drawn: there, use the mirror image of still water.
  if (seen.a < 0.3) seen = texture(mirror, gl_FragCoord.xy / vec2(textureSize(depth, 0)));
  return seen.a < 0.1 ? sky : seen.rgb / seen.a;
#endif
}

void main() {
  vec3 v = normalize(eye_W - p_W);
  vec3 flat_n = normalize(n_W);
  if (!gl_FrontFacing) flat_n = -flat_n;
  vec3 n = flat_n;
  float speed = length(flow);
  if (abs(flat_n.y) > 0.5) {
    vec2 sl = slope(p_W.xz, speed) / (1.0 + 0.012 * dot(eye_W - p_W, eye_W - p_W));
    n = normalize(flat_n - vec3(sl.x, 0.0, sl.y));
  }
  float nv = clamp(dot(n, v), 0.02, 1.0);
  vec3 r = reflect(-v, n);
  r.y = abs(r.y);
  // It fades out where it has no depth: at the bank, at things in it, and at its own sides.
  float deep_m = depth_of_water(flat_n);
  float side = 1.0;
  if (width_m > 0.0) side = smoothstep(0.0, 0.5, min(uv.x, 1.0 - uv.x) * width_m + 0.4 * (value_noise(p_W.xz * 0.9) - 0.5));
  float fresnel = (0.02 + 0.98 * pow(1.0 - nv, 5.0)) * smoothstep(0.0, 0.012, deep_m) * side;
  float cover = mix(0.92, 0.45, clearness) * (1.0 - exp(-60.0 * deep_m)) * side;
  float sun = sunlight(p_W, flat_n);
  float glint = pow(max(dot(r, to_sun), 0.0), 420.0) * 30.0 * sun;
  vec3 deep = vec3(0.022, 0.050, 0.042);
  vec3 from_above = irradiance_from_sky(vec3(0, 1, 0)) / kPi;
  vec3 body = deep * (from_above * 1.6 + sun_irradiance * 0.22 * sun);
  vec3 light = body * cover + mirrored_about(r) * fresnel + vec3(1.0, 0.9, 0.75) * glint * fresnel * 6.0;
  float opacity = clamp(cover + fresnel, 0.0, 1.0);
  if (speed > 0.0) {
    // A broken line of foam where the current touches a bank.
    float bank = smoothstep(0.002, 0.010, deep_m) * (1.0 - smoothstep(0.012, 0.045, deep_m));
    float torn = value_noise((p_W.xz - flow * time_s) * 7.0) * 0.6 + value_noise((p_W.xz - flow * time_s) * 19.0) * 0.4;
    float foam = 0.5 * side * bank * smoothstep(0.50, 0.75, torn);
    light = mix(light, 0.8 * (from_above + sun_irradiance / kPi * sun * max(to_sun.y, 0.0)), foam);
    opacity = mix(opacity, 1.0, foam);
  }
  colour = finish(vec4(through_air(light / max(opacity, 1e-3), p_W) * opacity, opacity));
}
