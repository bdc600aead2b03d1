in vec2 place;
out vec4 colour;
uniform mat4 R_WP;  // clip space to directions in W

// Height of a range of hills, by direction: the tangent of its elevation.
float hills(vec3 d, float scale, float height) {
  float a = atan(d.x, -d.z) * scale;
  return height * (0.25 + 0.60 * value_noise(vec2(a, 1.7)) + 0.30 * value_noise(vec2(a * 2.7, 5.1)) +
                   0.10 * value_noise(vec2(a * 8.3, 9.4)));
}

// Groves on the plain's rim: crowns beside each other, with gaps.
float trees(vec3 d) {
  float a = atan(d.x, -d.z);
  float grove = smoothstep(0.46, 0.62, value_noise(vec2(a * 7.0, 21.0)));
  return grove * 0.010 * (0.35 + 0.65 * value_noise(vec2(a * 170.0, 3.3))) - 0.002;
}

void main() {
  vec4 p = R_WP * vec4(place * 2.0 - 1.0, 1.0, 1.0);
  vec3 d = normalize(p.xyz / p.w);
  vec3 sky = with_clouds(sky_radiance(d), d);
  float elevation = d.y / max(length(d.xz), 1e-4);
  float soft = max(fwidth(elevation), 1e-5);
  vec3 far_hills = mix(vec3(0.16, 0.21, 0.25), haze_colour(), 0.72);
  vec3 near_hills = mix(vec3(0.15, 0.16, 0.09), haze_colour(), 0.52);
  vec3 groves = mix(vec3(0.075, 0.095, 0.045), haze_colour(), 0.42);
  sky = mix(sky, far_hills, smoothstep(soft, -soft, elevation - hills(d, 5.0, 0.062)));
  sky = mix(sky, near_hills, smoothstep(soft, -soft, elevation - hills(d, 9.0, 0.026)));
  sky = mix(sky, groves, smoothstep(soft, -soft, elevation - trees(d)));
  float disc = smoothstep(0.99985, 0.99995, dot(d, to_sun));
  colour = finish(vec4(sky + disc * vec3(12.0, 10.5, 8.0), 1.0));
}
