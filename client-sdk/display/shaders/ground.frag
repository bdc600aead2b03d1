// Dry trodden earth without end, by noise alone: patches of dust and of sparse grass, finer grain near the eye.
in vec3 p_W;
in vec3 n_W;
in vec4 t_W;
in vec2 uv;
out vec4 colour;

void main() {
  vec2 q = p_W.xz;
  float far = distance(eye_W, p_W);
  float patches = value_noise(q * 0.23) * 0.65 + value_noise(q * 0.9 + 7.0) * 0.35;
  float grain = 0.5;
  float tilt = 0.0;
  if (far < 25.0) {
    float fine = value_noise(q * 34.0) * 0.6 + value_noise(q * 9.0) * 0.4;
    grain = mix(fine, 0.5, smoothstep(6.0, 25.0, far));
    tilt = (value_noise(q * 34.0 + 0.35) - value_noise(q * 34.0)) * (1.0 - smoothstep(3.0, 12.0, far));
  }
  vec3 earth = mix(vec3(0.215, 0.155, 0.095), vec3(0.30, 0.225, 0.14), patches);
  vec3 grass = vec3(0.115, 0.125, 0.045);
  vec3 base = mix(earth, grass, 0.85 * smoothstep(0.38, 0.72, value_noise(q * 0.11 + 19.0) * 0.45 + value_noise(q * 0.63 + 3.0) * 0.3 + grain * 0.25));
  base *= 0.66 + 0.5 * grain;
  vec3 n = normalize(vec3(tilt * 0.35, 1.0, tilt * 0.25));
  Surface s = Surface(base, 0.0, 0.95, n);
  colour = vec4(through_air(shade(s, p_W, vec3(0, 1, 0)), p_W), 1.0);
}
