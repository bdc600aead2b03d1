// Earth: the plain around an exhibit, and the exhibit's own earth.
in vec3 p_W;
in vec3 n_W;
in vec4 t_W;
in vec2 uv;
out vec4 colour;

uniform sampler2D base_image;
uniform sampler2D normal_image;
uniform float plain_height_m;

void main() {
  vec3 n = normalize(n_W);
  if (!gl_FrontFacing) n = -n;
  vec2 q = p_W.xz;
  // The cut side of a piece of land looks as if the land continued over it: lit from above, with the texture from further out.
  if (abs(n.y) < 0.35) {
    q -= p_W.y * n.xz;
    n = vec3(0.0, 1.0, 0.0);
  }
  // Where it meets the plain its normal becomes vertical, or the sloping rim would be visible by its shading.
  n = normalize(mix(n, vec3(0.0, 1.0, 0.0), 1.0 - smoothstep(0.02, 0.12, abs(p_W.y - plain_height_m))));
  Surface s = Surface(land_base(base_image, q, distance(eye_W, p_W)), 0.0, 0.95, land_normal(normal_image, q, n), 1.0);
  colour = finish(vec4(through_air(shade(s, p_W, n), p_W), 1.0));
}
