// One puff: a square that faces the eye, lit as a whole.
layout(location = 0) in vec3 middle_W;
layout(location = 1) in float radius_m;
layout(location = 2) in vec4 tint_in;
layout(location = 3) in vec3 look_in;  // spin, seed, shape: 0 puff, 1 drop, 2 flame

uniform mat4 V_CW;
uniform mat4 P;

out vec2 place;       // -1..1
out vec2 turned;      // the same, with the puff's own spin
out vec3 p_W;
flat out vec4 tint;
flat out vec3 look;
flat out float radius;
flat out float sun;
#ifdef LOW
out vec3 shown;  // its colour on the screen: computed here, a picture of steam costs a tenth
#endif

void main() {
  place = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID & 2) - 1);
  float s = sin(look_in.x);
  float c = cos(look_in.x);
  turned = mat2(c, s, -s, c) * place;
  // Flames are stretched upwards.
  vec2 size = look_in.z > 1.5 ? vec2(0.85, 1.6) : vec2(1.0);
  vec4 p_C = V_CW * vec4(middle_W, 1.0) + vec4(place * size * radius_m, 0.0, 0.0);
  p_W = middle_W;
  tint = tint_in;
  look = look_in;
  radius = radius_m;
  sun = look_in.z > 1.5 ? 0.0 : sunlight(middle_W, to_sun);
  gl_Position = P * p_C;
#ifdef LOW
  // The ball's normal half way to this corner.
  vec3 n = transpose(mat3(V_CW)) * vec3(place * 0.6, 0.53);
  vec3 light = look_in.z > 1.5 ? tint.rgb : puff_light(n, p_W, sun, look_in.z) * tint.rgb;
  shown = srgb(aces((look_in.z > 1.5 ? light : through_air(light, p_W)) * exposure));
#endif
}
