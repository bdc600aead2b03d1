// The tiers `low` and `cached`: less light is computed, and what moves has a shadow map of its own.
#define LOW
uniform sampler2DArrayShadow mover_map;  // what stands still is not in it
uniform mat4 mover_PV;  // W to its clip space
uniform float mover_lift_m;  // along the normal, so that a mover does not shade itself; 0 for what stands still
uniform bool movers_shade;  // false: there is no such map

// Of the light of shade_apart(), what came from the sun: a mover's shadow takes it away again.
vec3 from_sun = vec3(0.0);

// Samples of a shadow map: corners of a square, opposite ones first. What moves is lit anew in each picture, and gets fewer.
int low_taps() { return mover_lift_m > 0.0 ? 2 : 4; }
vec2 low_tap(int i) { return vec2(i & 1, (i ^ (i >> 1)) & 1) * 2.0 - 1.0; }

// The share of the sun that passes all movers. Beyond the map nothing moves: its border is empty.
float sun_past_movers(vec3 p_W, vec3 n) {
  vec3 q = (mover_PV * vec4(p_W + mover_lift_m * n, 1.0)).xyz * 0.5 + 0.5;
  q.z = min(q.z - 0.002, 1.0);
  vec2 texel = 1.0 / vec2(textureSize(mover_map, 0).xy);
  int taps = movers_shade && max(abs(q.x - 0.5), abs(q.y - 0.5)) < 0.5 ? low_taps() : 0;
  float sum = 0.0;
  for (int i = 0; i < taps; ++i)
    sum += texture(mover_map, vec4(q.xy + low_tap(i) * 0.8 * texel, 0.0, q.z));
  return taps == 0 ? 1.0 : sum / float(taps);
}
