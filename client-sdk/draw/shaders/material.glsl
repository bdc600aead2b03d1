// What a mesh is made of: glTF's metallic-roughness material at a fragment.
in vec3 p_W;
in vec3 n_W;
in vec4 t_W;
in vec2 uv;
out vec4 colour;

uniform vec4 base_colour;
uniform vec3 emissive;
uniform float metallic;
uniform float roughness;
uniform float alpha_cutoff;
uniform float occlusion_strength;
uniform int images;  // bits: 1 base colour, 2 normal, 4 metallic-roughness, 8 emissive, 16 occlusion
uniform sampler2D base_image;
uniform sampler2D normal_image;
uniform sampler2D metallic_roughness_image;
uniform sampler2D emissive_image;
uniform sampler2D occlusion_image;

// Discards fragments by alpha_cutoff. `n` is the geometric normal on the eye's side.
Surface material(out vec3 n, out float opacity, out vec3 glow) {
  vec4 base = base_colour;
  if ((images & 1) != 0) base *= texture(base_image, uv);
  if (base.a < alpha_cutoff) discard;
  opacity = base.a;
  n = normalize(n_W);
  if (!gl_FrontFacing) n = -n;
  Surface s = Surface(base.rgb, metallic, roughness, n, 1.0);
  if ((images & 4) != 0) {
    vec3 mr = texture(metallic_roughness_image, uv).rgb;
    s.roughness *= mr.g;
    s.metallic *= mr.b;
  }
  s.roughness = clamp(s.roughness, 0.05, 1.0);
  if ((images & 2) != 0) {
    vec3 t = normalize(t_W.xyz - n * dot(t_W.xyz, n));
    vec3 m = texture(normal_image, uv).xyz * 2.0 - 1.0;
    s.n = normalize(t * m.x + cross(n, t) * t_W.w * m.y + n * m.z);
  }
  if ((images & 16) != 0) s.open = 1.0 + occlusion_strength * (texture(occlusion_image, uv).r - 1.0);
  glow = emissive;
  if ((images & 8) != 0) glow *= texture(emissive_image, uv).rgb;
  return s;
}
