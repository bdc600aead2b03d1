// Smooths the 4 x 4 pattern of ambient_occlusion.frag, but not across edges.
in vec2 place;
out vec4 colour;
uniform sampler2D openness;

void main() {
  ivec2 last = textureSize(openness, 0) - 1;
  ivec2 at = ivec2(gl_FragCoord.xy);
  float far = texelFetch(openness, at, 0).g;
  float sum = 0.0;
  float weights = 1e-4;
  for (int i = 0; i < 16; ++i) {
    vec2 one = texelFetch(openness, clamp(at + ivec2((i & 3) - 2, (i >> 2) - 2), ivec2(0), last), 0).rg;
    float w = max(1.0 - abs(one.g - far) / (0.03 * far), 0.0);
    sum += w * one.r;
    weights += w;
  }
  colour = vec4((sum + 1e-4) / weights, 0.0, 0.0, 1.0);
}
