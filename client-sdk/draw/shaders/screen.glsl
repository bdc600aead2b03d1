// Light becomes a screen colour at once; what is blended over it later is blended as screen colours.
layout(location = 1) out vec4 all_light;  // for a mover's shadow that falls there later
layout(location = 2) out vec4 sun_light;  // its share that came from the sun

vec4 finish(vec4 light) {
  all_light = vec4(light.rgb, 1.0);
  sun_light = vec4(from_sun, 1.0);
  float cover = light.a > 0.0 ? light.a : 1.0;
  return vec4(srgb(aces(light.rgb / cover * exposure)) * cover, light.a);
}
