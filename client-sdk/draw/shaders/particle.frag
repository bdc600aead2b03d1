in vec2 place;
in vec2 turned;
in vec3 p_W;
flat in vec4 tint;
flat in vec3 look;
flat in float radius;
flat in float sun;
#ifdef LOW
in vec3 shown;
#endif
out vec4 colour;

uniform sampler2D depth;
uniform vec2 depth_to_m;  // of clip space: distance before the eye = y / (x + depth)
uniform mat4 V_CW;

float metres(float z) { return depth_to_m.y / (depth_to_m.x + 2.0 * z - 1.0); }

void main() {
  float r = length(place);
  if (r > 1.0) discard;
  float body;
  if (look.z > 0.5 && look.z < 1.5) {
    body = smoothstep(1.0, 0.55, r);
  } else {
    vec2 q = turned * 1.9 + look.y * vec2(61.0, 37.0);
#ifdef LOW
    float lumps = value_noise(q * 1.4);
#else
    float lumps = value_noise(q) * 0.62 + value_noise(q * 2.6 + 11.0) * 0.38;
#endif
    body = smoothstep(1.0, 0.10, r + (0.5 - lumps) * 0.75) * smoothstep(1.0, 0.8, r);
  }
  // A puff fades out in front of a wall, and near the eye.
  float z_m = metres(gl_FragCoord.z);
  float behind_m = metres(texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r) - z_m;
  float opacity = tint.a * body * clamp(behind_m / (0.5 * radius + 0.002), 0.0, 1.0) * clamp(z_m * 4.0 - 0.4, 0.0, 1.0);
#ifdef LOW
  // Flames add their light and hide nothing; the root is near the screen's curve.
  colour = look.z > 1.5 ? vec4(shown * sqrt(opacity * body), 0.0) : vec4(shown * opacity, opacity);
#else
  if (look.z > 1.5) {
    // Flames add their light and hide nothing.
    colour = finish(vec4(tint.rgb * opacity * body, 0.0));
    return;
  }
  vec3 n_C = vec3(place, sqrt(max(1.0 - r * r, 0.0)));
  vec3 n = transpose(mat3(V_CW)) * n_C;
  colour = finish(vec4(through_air(puff_light(n, p_W, sun, look.z) * tint.rgb, p_W) * opacity, opacity));
#endif
}
