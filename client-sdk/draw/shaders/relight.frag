// The kept picture of what stands still, where a mover's shadow falls.
in vec2 place;
out vec4 colour;
uniform sampler2D kept_depth;
uniform sampler2D kept_all_light;
uniform sampler2D kept_sun_light;
uniform mat4 X_WP;  // clip space to W

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 p = X_WP * vec4(vec3(place, texelFetch(kept_depth, at, 0).r) * 2.0 - 1.0, 1.0);
  float sun = sun_past_movers(p.xyz / p.w, vec3(0.0));
  if (sun > 0.999) discard;
  vec3 light = texelFetch(kept_all_light, at, 0).rgb - texelFetch(kept_sun_light, at, 0).rgb * (1.0 - sun);
  colour = vec4(srgb(aces(max(light, 0.0) * exposure)), 1.0);
}
