// The sky as a map by longitude and latitude, from which the ambient light is made.
in vec2 place;
out vec4 colour;
void main() {
  float longitude = (place.x - 0.5) * 6.2831853;
  float polar = place.y * 3.14159265;
  vec3 d = vec3(sin(polar) * sin(longitude), cos(polar), -sin(polar) * cos(longitude));
  colour = vec4(sky_radiance(d), 1.0);
}
