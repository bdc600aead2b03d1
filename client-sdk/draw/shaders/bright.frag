// What is brighter than a screen can show, at a quarter of the picture's size: four by four pixels, one sample of each.
out vec4 colour;
uniform sampler2DMS samples;
uniform int sample_count;
uniform float exposure;

const float kThreshold = 1.5;  // sunlit limestone is just below

void main() {
  ivec2 last = textureSize(samples) - 1;
  ivec2 first = ivec2(gl_FragCoord.xy) * 4;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 16; ++i) {
    // NaN and infinity would spread over the whole picture.
    vec3 c = texelFetch(samples, min(first + ivec2(i & 3, i >> 2), last), i % sample_count).rgb * exposure;
    c = clamp(c, 0.0, 40.0);
    float l = dot(c, vec3(0.2126, 0.7152, 0.0722));
    sum += c * max(l - kThreshold, 0.0) / max(l, 1e-4);
  }
  colour = vec4(sum / 16.0, 1.0);
}
