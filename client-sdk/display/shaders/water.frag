// Water from above: the sky mirrored by Fresnel over a body that lets the bottom through. Ripples move with the world's time.
in vec3 p_W;
in vec3 n_W;
in vec4 t_W;
in vec2 uv;
out vec4 colour;

uniform float time_s;
uniform float clearness;
uniform float ripple;

vec2 slope(vec2 q) {
  vec2 sum = vec2(0.0);
  float strength = 0.050;
  float length_m = 0.85;
  float a = 0.4;
  for (int i = 0; i < 5; ++i) {
    vec2 d = vec2(cos(a), sin(a));
    float k = 6.2831853 / length_m;
    sum += d * cos(k * dot(d, q) - sqrt(9.81 * k) * time_s) * strength;
    a += 2.2;
    length_m *= 0.62;
    strength *= 0.78;
  }
  return sum * ripple;
}

void main() {
  vec3 v = normalize(eye_W - p_W);
  vec3 flat_n = normalize(n_W);
  if (!gl_FrontFacing) flat_n = -flat_n;
  vec3 n = flat_n;
  if (abs(flat_n.y) > 0.5) {
    vec2 sl = slope(p_W.xz) / (1.0 + 0.012 * dot(eye_W - p_W, eye_W - p_W));
    n = normalize(flat_n - vec3(sl.x, 0.0, sl.y));
  }
  float nv = clamp(dot(n, v), 0.02, 1.0);
  float fresnel = 0.02 + 0.98 * pow(1.0 - nv, 5.0);
  vec3 r = reflect(-v, n);
  r.y = abs(r.y);
  float sun = sunlight(p_W, flat_n);
  float glint = pow(max(dot(r, to_sun), 0.0), 420.0) * 30.0 * sun;
  vec3 deep = vec3(0.022, 0.050, 0.042);
  vec3 body = deep * (irradiance_from_sky(vec3(0, 1, 0)) / kPi * 1.6 + sun_irradiance * 0.22 * sun);
  float cover = mix(0.92, 0.45, clearness);
  vec3 light = body * cover + reflected_sky(r, 0.05) * fresnel + vec3(1.0, 0.9, 0.75) * glint * fresnel * 6.0;
  float opacity = clamp(cover + fresnel, 0.0, 1.0);
  colour = vec4(through_air(light / opacity, p_W) * opacity, opacity);
}
