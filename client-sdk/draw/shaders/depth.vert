layout(location = 0) in vec3 p_M;
uniform mat4 X_WM[32];  // of each instance
uniform mat4 PV;
void main() { gl_Position = PV * (X_WM[gl_InstanceID] * vec4(p_M, 1.0)); }
