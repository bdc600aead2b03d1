// Laid rope: three twisted strands, as relief and as colour, by the length along the rope.
in vec3 p_W;
in vec3 n_W;
in vec4 t_W;
in vec2 uv;  // x about the rope, y along it in radii
out vec4 colour;

const float kStrands = 3.0;
const float kLay = 7.0;  // radii along the rope for one turn of a strand

void main() {
  vec3 n = normalize(n_W);
  vec3 t = normalize(t_W.xyz);
  float q = kStrands * (uv.x + uv.y / kLay);
  float across = fract(q) - 0.5;
  float strand = mod(floor(q), kStrands);
  // From afar a strand is smaller than a pixel: its relief fades, its mean colour stays.
  float detail = 1.0 - smoothstep(0.30, 0.80, length(vec2(dFdx(uv.x + uv.y / kLay), dFdy(uv.x + uv.y / kLay))) * kStrands);
  vec3 g = cross(t, n) / 6.2831853 + t / kLay;
  g = normalize(g - n * dot(n, g) + 1e-5 * t);
  vec3 bulged = normalize(n + g * across * 2.6 * detail);
  float groove = mix(0.78, mix(0.30, 1.0, smoothstep(0.50, 0.24, abs(across))), detail);
  float fibre = value_noise(vec2(across * 9.0 + strand * 17.0, uv.y * 0.9)) * 0.6 + value_noise(vec2(across * 23.0 + strand * 31.0, uv.y * 2.3)) * 0.4;
  vec3 hemp = mix(vec3(0.30, 0.205, 0.10), vec3(0.52, 0.385, 0.205), mix(0.5, fibre, detail));
  Surface s = Surface(hemp * groove, 0.0, 0.92, bulged, 1.0);
  colour = finish(vec4(through_air(shade(s, p_W, n), p_W), 1.0));
}
