// Falling water: bright streaks that run along the fall with the world's time.
in vec3 p_W;
in vec3 n_W;
in vec4 t_W;
in vec2 uv;  // x about the stream, y seconds since the water left the spout
out vec4 colour;

uniform float time_s;
uniform float lumps_per_s;
uniform float broken_s;  // when a jet's core has broken up

void main() {
  vec3 v = normalize(eye_W - p_W);
  vec3 n = normalize(n_W);
  if (!gl_FrontFacing) n = -n;
  float streak = value_noise(vec2(uv.x * 14.0, (uv.y - time_s) * 16.0));
  streak = 0.6 * streak + 0.4 * value_noise(vec2(uv.x * 31.0, (uv.y - time_s) * 37.0));
  float fresnel = 0.03 + 0.97 * pow(1.0 - clamp(dot(n, v), 0.0, 1.0), 4.0);
  vec3 white = irradiance_from_sky(n) / kPi + sun_irradiance * 0.10 * (0.4 + 0.6 * max(dot(n, to_sun), 0.0));
  vec3 light = white * (0.25 + 0.75 * smoothstep(0.35, 0.8, streak)) + reflected_sky(reflect(-v, n), 0.1) * fresnel;
  float opacity = clamp(0.22 + 0.55 * smoothstep(0.3, 0.85, streak) + fresnel * 0.6, 0.0, 0.95);
  float gone = mix(-0.2, 1.2, smoothstep(0.55, 1.5, uv.y / broken_s));
  if (gone > 0.0) {
    float lump = value_noise(vec2(uv.x * 2.0, (uv.y - time_s) * lumps_per_s)) * 0.7 + value_noise(vec2(uv.x * 5.0, (uv.y - time_s) * lumps_per_s * 2.3)) * 0.3;
    opacity *= smoothstep(gone - 0.18, gone + 0.18, lump);
  }
  colour = finish(vec4(through_air(light, p_W) * opacity, opacity));
}
