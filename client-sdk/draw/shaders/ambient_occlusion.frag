// The share of the sky that nearby things hide, from the picture's depth alone: scalable ambient obscurance (McGuire 2012).
out vec4 colour;
uniform sampler2D depth;
uniform vec2 depth_to_m;  // of clip space: distance before the eye = y / (x + depth)
uniform vec4 rays;        // xy: across and up at one metre for clip space 1; zw: where clip space 0 looks
uniform float pixels_per_m;  // at one metre

const float kReach_m = 0.25;
const int kTaps = 12;

// At the pixel's centre: half a pixel beside it, a floor seen at a grazing angle would have steps.
vec3 seen(vec2 at) {
  vec2 size = vec2(textureSize(depth, 0));
  at = (clamp(floor(at * size), vec2(0.0), size - 1.0) + 0.5) / size;
  float m = depth_to_m.y / (depth_to_m.x + 2.0 * textureLod(depth, at, 0.0).r - 1.0);
  return vec3((at * 2.0 - 1.0) * rays.xy + rays.zw, -1.0) * m;
}

// Of two differences, the smaller one: it stays on this surface.
vec3 lesser(vec3 a, vec3 b) { return abs(a.z) < abs(b.z) ? a : b; }

void main() {
  vec2 texel = 1.0 / vec2(textureSize(depth, 0));
  vec2 here = (floor(gl_FragCoord.xy) * 2.0 + 0.5) * texel;
  vec3 p = seen(here);
  vec3 across = lesser(seen(here + vec2(texel.x, 0.0)) - p, p - seen(here - vec2(texel.x, 0.0)));
  vec3 up = lesser(seen(here + vec2(0.0, texel.y)) - p, p - seen(here - vec2(0.0, texel.y)));
  vec3 n = normalize(cross(across, up));
  float far = -p.z;
  float reach = clamp(kReach_m * pixels_per_m / far, 2.0, 90.0);
  // A pattern of 4 x 4 pixels, which the following blur smooths out.
  ivec2 cell = ivec2(gl_FragCoord.xy) & 3;
  float start = float((cell.x * 5 + cell.y * 7 + (cell.x ^ cell.y) * 3) & 15) * 0.3927;
  float hidden = 0.0;
  for (int i = 0; i < kTaps; ++i) {
    float r = (float(i) + 0.5) / float(kTaps);
    float a = start + float(i) * 2.39996;
    vec3 v = seen(here + vec2(cos(a), sin(a)) * r * reach * texel) - p;
    float vv = dot(v, v);
    float f = max(kReach_m * kReach_m - vv, 0.0);
    hidden += f * f * f * max((dot(v, n) - 0.004 - 0.0015 * far) / (vv + 0.0006), 0.0);
  }
  hidden *= 0.40 * 5.0 / (pow(kReach_m, 6.0) * float(kTaps));
  // Beyond some metres it fades out.
  float open = mix(max(1.0 - hidden, 0.0), 1.0, smoothstep(30.0, 60.0, far));
  colour = vec4(open, far, 0.0, 1.0);
}
