// From linear light to screen colours: a pixel's samples are averaged with less weight for the brightest (no ragged edges at
// glints), darkened by ambient occlusion, with a glow around glaring things; then ACES (Stephen Hill's fit of RRT and ODT),
// then the sRGB curve.
in vec2 place;
out vec4 colour;
uniform sampler2DMS samples;
uniform int sample_count;
uniform float exposure;
uniform sampler2D bloom;  // glaring light, in the picture's own exposure
uniform sampler2D openness;  // share of the sky that is open
uniform float bloom_share;
uniform float occlusion_share;  // 0: both are left out

vec3 aces(vec3 c) {
  const mat3 into = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
  const mat3 out_of = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
  c = into * c;
  c = (c * (c + 0.0245786) - 0.000090537) / (c * (0.983729 * c + 0.4329510) + 0.238081);
  return clamp(out_of * c, 0.0, 1.0);
}

vec3 srgb(vec3 c) { return mix(12.92 * c, 1.055 * pow(max(c, vec3(1e-6)), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c)); }

void main() {
  ivec2 at = ivec2(place * vec2(textureSize(samples)));
  vec3 sum = vec3(0.0);
  float weights = 0.0;
  for (int i = 0; i < sample_count; ++i) {
    vec3 c = texelFetch(samples, at, i).rgb * exposure;
    float w = 1.0 / (1.0 + dot(c, vec3(0.2126, 0.7152, 0.0722)));
    sum += c * w;
    weights += w;
  }
  vec3 light = sum / weights * mix(1.0, texture(openness, place).r, occlusion_share);
  light += bloom_share * texture(bloom, place).rgb;
  colour = vec4(srgb(aces(light)), 1.0);
}
