// Four places around this one, each between four texels.
in vec2 place;
out vec4 colour;
uniform sampler2D from;
uniform float reach;  // texels

void main() {
  vec2 t = reach / vec2(textureSize(from, 0));
  colour = vec4(0.25 * (texture(from, place + t).rgb + texture(from, place - t).rgb + texture(from, place + t * vec2(1, -1)).rgb +
                        texture(from, place + t * vec2(-1, 1)).rgb), 1.0);
}
