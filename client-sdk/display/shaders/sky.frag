in vec2 place;
out vec4 colour;
uniform mat4 R_WP;  // clip space to directions in W

void main() {
  vec4 p = R_WP * vec4(place * 2.0 - 1.0, 1.0, 1.0);
  vec3 d = normalize(p.xyz / p.w);
  vec3 sky = sky_radiance(d);
  float disc = smoothstep(0.99985, 0.99995, dot(d, to_sun));
  colour = vec4(sky + disc * vec3(12.0, 10.5, 8.0), 1.0);
}
