// Prefilters a cube map for a roughness, seen at normal incidence: the first factor of the split sum (B. Karis, "Real
// Shading in Unreal Engine 4", 2013). Directions are sampled by GGX; each uses a mip level that matches the samples' spacing
// (Krivanek & Colbert 2008), so that a few are enough and small bright spots leave no specks.
in vec2 place;
out vec4 colour;
uniform samplerCube sharp;
uniform float roughness;
uniform int samples;

const float kPi = 3.14159265;

// Van der Corput's sequence: the bits of i, reversed behind the binary point.
float mirrored_bits(int i) {
  float sum = 0.0;
  for (float share = 0.5; i > 0; share *= 0.5, i /= 2)
    sum += share * float(i % 2);
  return sum;
}

void main() {
  vec3 n = normalize(cube_direction(place * 2.0 - 1.0));
  vec3 t = normalize(cross(abs(n.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), n));
  vec3 b = cross(n, t);
  float a2 = max(pow(roughness, 4.0), 1e-8);
  float size = float(textureSize(sharp, 0).x);
  vec3 sum = vec3(0.0);
  float weights = 0.0;
  for (int i = 0; i < samples; ++i) {
    float u = (float(i) + 0.5) / float(samples);
    float around = 2.0 * kPi * mirrored_bits(i);
    float spread = 1.0 + (a2 - 1.0) * u;
    float nh2 = (1.0 - u) / spread;  // squared cosine from the normal to the half vector
    float nl = 2.0 * nh2 - 1.0;
    if (nl <= 0.0) continue;
    float side = 2.0 * sqrt(nh2 * (1.0 - nh2));
    vec3 l = side * (cos(around) * t + sin(around) * b) + nl * n;
    float density = spread * spread / (kPi * a2) / 4.0;  // of l, by solid angle
    float texels = 6.0 * size * size / (4.0 * kPi * float(samples) * density);
    sum += nl * textureLod(sharp, l, 0.5 * log2(texels)).rgb;
    weights += nl;
  }
  colour = vec4(sum / weights, 1.0);
}
