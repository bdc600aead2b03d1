// Direction, of any length, of a place (-1 to 1) on a cube map's face: +x, -x, +y, -y, +z, -z, as OpenGL lays them out.
uniform int face;

vec3 cube_direction(vec2 st) {
  if (face == 0) return vec3(1.0, -st.y, -st.x);
  if (face == 1) return vec3(-1.0, -st.y, st.x);
  if (face == 2) return vec3(st.x, 1.0, st.y);
  if (face == 3) return vec3(st.x, -1.0, -st.y);
  if (face == 4) return vec3(st.x, -st.y, 1.0);
  return vec3(-st.x, -st.y, -1.0);
}
