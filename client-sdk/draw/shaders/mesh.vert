layout(location = 0) in vec3 p_M;
layout(location = 1) in vec3 n_M;
layout(location = 2) in vec4 t_M;
layout(location = 3) in vec2 uv_in;

uniform mat4 X_WM[32];  // of each instance
uniform mat3 N_WM[32];  // inverse transposes of their linear parts
uniform mat4 PV;
uniform vec4 clip_W;  // a plane: parts below it may be clipped

out vec3 p_W;
out vec3 n_W;
out vec4 t_W;
out vec2 uv;

void main() {
  vec4 p = X_WM[gl_InstanceID] * vec4(p_M, 1.0);
  p_W = p.xyz;
  n_W = N_WM[gl_InstanceID] * n_M;
  t_W = vec4(mat3(X_WM[gl_InstanceID]) * t_M.xyz, t_M.w);
  uv = uv_in;
  gl_Position = PV * p;
  gl_ClipDistance[0] = dot(clip_W, p);
}
