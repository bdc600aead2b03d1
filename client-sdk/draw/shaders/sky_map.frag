// The sky as a map by longitude and latitude, from which the ambient light is made.
in vec2 place;
out vec4 colour;
uniform int clouds;  // 0: without them
void main() {
  float longitude = (place.x - 0.5) * 6.2831853;
  float polar = place.y * 3.14159265;
  vec3 d = vec3(sin(polar) * sin(longitude), cos(polar), -sin(polar) * cos(longitude));
  vec3 clear = sky_radiance(d);
  colour = vec4(clouds != 0 ? with_clouds(clear, d) : clear, 1.0);
}
