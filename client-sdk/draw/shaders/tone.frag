// From linear light to screen colours: a pixel's samples are averaged with less weight for the brightest (no ragged edges at
// glints), darkened by ambient occlusion, with a glow around glaring things; then ACES (Stephen Hill's fit of RRT and ODT),
// then the sRGB curve.
in vec2 place;
out vec4 colour;
uniform sampler2DMS samples;
uniform int sample_count;
uniform sampler2D bloom;  // glaring light, in the picture's own exposure
uniform sampler2D openness;  // share of the sky that is open
uniform float bloom_share;
uniform float occlusion_share;  // 0: both are left out

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
