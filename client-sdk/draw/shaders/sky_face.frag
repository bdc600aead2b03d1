// The sky, and the earth below its horizon, on a face of a cube map.
in vec2 place;
out vec4 colour;
void main() { colour = vec4(sky_radiance(normalize(cube_direction(place * 2.0 - 1.0))), 1.0); }
