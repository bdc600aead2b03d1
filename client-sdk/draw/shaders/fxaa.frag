// Smooths edges of a finished picture by its brightness alone: along an edge that is found by the four diagonal neighbours, two
// samples on either side, or four where two stay within the neighbours' range (T. Lottes, "FXAA", 2009, its shortest form).
in vec2 place;
out vec4 colour;
uniform sampler2D picture;

float bright(vec3 c) { return dot(c, vec3(0.299, 0.587, 0.114)); }

void main() {
  vec2 texel = 1.0 / vec2(textureSize(picture, 0));
  vec3 here = textureLod(picture, place, 0.0).rgb;
  float nw = bright(textureLod(picture, place + vec2(-1.0, 1.0) * texel, 0.0).rgb);
  float ne = bright(textureLod(picture, place + vec2(1.0, 1.0) * texel, 0.0).rgb);
  float sw = bright(textureLod(picture, place + vec2(-1.0, -1.0) * texel, 0.0).rgb);
  float se = bright(textureLod(picture, place + vec2(1.0, -1.0) * texel, 0.0).rgb);
  float mid = bright(here);
  float least = min(mid, min(min(nw, ne), min(sw, se)));
  float most = max(mid, max(max(nw, ne), max(sw, se)));
  vec2 along = vec2(sw + se - nw - ne, ne + se - nw - sw);
  float tame = max((nw + ne + sw + se) * 0.03125, 0.0078125);
  along = clamp(along / (min(abs(along.x), abs(along.y)) + tame), -8.0, 8.0) * texel;
  vec3 two = 0.5 * (textureLod(picture, place - along / 6.0, 0.0).rgb + textureLod(picture, place + along / 6.0, 0.0).rgb);
  vec3 four = 0.5 * two + 0.25 * (textureLod(picture, place - 0.5 * along, 0.0).rgb + textureLod(picture, place + 0.5 * along, 0.0).rgb);
  float b = bright(four);
  colour = vec4(most - least < 0.06 ? here : b < least || b > most ? two : four, 1.0);
}
