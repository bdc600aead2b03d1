layout(location = 0) in vec2 at;     // pixels, origin in the upper left corner
layout(location = 1) in vec2 uv_in;  // text: place in the atlas; shapes: pixels from the shape's middle
layout(location = 2) in vec4 colour_in;
layout(location = 3) in vec4 shape_in;  // half width, half height, corner radius; w: 1 a shape, 0 text
uniform vec2 size;
out vec2 uv;
out vec4 tint;
out vec4 shape;
void main() {
  uv = uv_in;
  tint = colour_in;
  shape = shape_in;
  gl_Position = vec4(at.x / size.x * 2.0 - 1.0, 1.0 - at.y / size.y * 2.0, 0.0, 1.0);
}
