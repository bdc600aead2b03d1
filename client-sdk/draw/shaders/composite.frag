// Combines both eyes' finished pictures.
in vec2 place;
out vec4 colour;
uniform sampler2D left_eye;
uniform sampler2D right_eye;
uniform bool rows;  // else anaglyph
uniform int right_rows;  // counted from above: the right eye has the even rows (0) or the odd ones (1)

vec3 linear(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c)); }
vec3 srgb(vec3 c) { return mix(12.92 * c, 1.055 * pow(max(c, vec3(1e-6)), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c)); }

// Least squares in CIE XYZ of what both eyes see through red and cyan filters: E. Dubois, "A projection method to generate anaglyph stereo
// images", ICASSP 2001; the published numbers for an LCD. Each row of both matrices together maps white to white.
const mat3 from_left = transpose(mat3(0.4561, 0.500484, 0.176381, -0.0400822, -0.0378246, -0.0157589, -0.0152161, -0.0205971, -0.00546856));
const mat3 from_right = transpose(mat3(-0.0434706, -0.0879388, -0.00155529, 0.378476, 0.73364, -0.0184503, -0.0721527, -0.112961, 1.2264));

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 l = texelFetch(left_eye, at, 0).rgb;
  vec3 r = texelFetch(right_eye, at, 0).rgb;
  if (rows) {
    int row = textureSize(left_eye, 0).y - 1 - at.y;
    colour = vec4((row & 1) == right_rows ? r : l, 1.0);
  } else {
    colour = vec4(srgb(clamp(from_left * linear(l) + from_right * linear(r), 0.0, 1.0)), 1.0);
  }
}
