// Both eyes' pictures in the same pixels, for red-cyan glasses or a screen of polarised rows: client-sdk/draw/shaders/composite.frag.
import {
  HalfFloatType, Mesh, NoBlending, OrthographicCamera, PlaneGeometry, Scene, ShaderMaterial, type Texture, type WebGLRenderer,
  WebGLRenderTarget,
} from 'three';

const kVertex = 'varying vec2 place; void main() { place = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }';
// The anaglyph is E. Dubois' least squares of what eyes see through the filters, as in the native display.
const kFragment = `
varying vec2 place;
uniform sampler2D leftEye;
uniform sampler2D rightEye;
uniform bool rows;
uniform int rightRows;
uniform int height;
const mat3 fromLeft = mat3(0.4561, -0.0400822, -0.0152161, 0.500484, -0.0378246, -0.0205971, 0.176381, -0.0157589, -0.00546856);
const mat3 fromRight = mat3(-0.0434706, 0.378476, -0.0721527, -0.0879388, 0.73364, -0.112961, -0.00155529, -0.0184503, 1.2264);
vec3 shown(vec3 c) {
#ifdef TONE_MAPPING
  c = toneMapping(c);
#endif
  return c;
}
void main() {
  vec3 l = shown(texture2D(leftEye, place).rgb);
  vec3 r = shown(texture2D(rightEye, place).rgb);
  int row = height - 1 - int(gl_FragCoord.y);
  vec3 c = rows ? ((row & 1) == rightRows ? r : l) : clamp(fromLeft * l + fromRight * r, 0.0, 1.0);
  gl_FragColor = vec4(c, 1.0);
  #include <colorspace_fragment>
}`;

export class EyeMixer {
  private readonly targets: [WebGLRenderTarget, WebGLRenderTarget];
  private readonly scene = new Scene();
  private readonly camera = new OrthographicCamera();
  private readonly material: ShaderMaterial;

  constructor(rows: boolean, rightEyeFirst: boolean, samples: number) {
    const target = (): WebGLRenderTarget => new WebGLRenderTarget(1, 1, { type: HalfFloatType, samples });
    this.targets = [target(), target()];
    const texture = (k: 0 | 1): { value: Texture } => ({ value: this.targets[k].texture });
    this.material = new ShaderMaterial({
      vertexShader: kVertex, fragmentShader: kFragment, depthTest: false, depthWrite: false, blending: NoBlending,
      uniforms: {
        leftEye: texture(0), rightEye: texture(1), rows: { value: rows }, rightRows: { value: rightEyeFirst ? 0 : 1 }, height: { value: 1 },
      },
    });
    const mesh = new Mesh(new PlaneGeometry(2, 2), this.material);
    mesh.frustumCulled = false;
    this.scene.add(mesh);
  }
  /** Pixels of each eye's picture. */
  resize(width: number, height: number): void {
    for (const target of this.targets) target.setSize(Math.max(Math.round(width), 1), Math.max(Math.round(height), 1));
  }
  target(k: number): WebGLRenderTarget {
    return this.targets[k]!;
  }
  /** On the whole canvas. */
  mix(renderer: WebGLRenderer): void {
    this.material.uniforms['height']!.value = renderer.domElement.height;
    renderer.setRenderTarget(null);
    renderer.render(this.scene, this.camera);
  }
}
