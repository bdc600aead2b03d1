// Earth: the plain about an exhibit, and what of an exhibit is earth.
in vec3 p_W;
in vec3 n_W;
in vec4 t_W;
in vec2 uv;
out vec4 colour;

uniform sampler2D base_image;
uniform sampler2D normal_image;

void main() {
  vec3 n = normalize(n_W);
  if (!gl_FrontFacing) n = -n;
  // Upwards where the land is seen from the side: a piece's own edge has no light of its own.
  if (abs(n.y) < 0.35) n = vec3(0.0, 1.0, 0.0);
  Surface s = Surface(land_base(base_image, p_W.xz, distance(eye_W, p_W)), 0.0, 0.95, land_normal(normal_image, p_W.xz, n));
  colour = vec4(through_air(shade(s, p_W, n), p_W), 1.0);
}
