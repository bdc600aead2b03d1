// The words in a headset: a calm board beside the work, whose buttons are pressed by a ray and a pinch.
import { CanvasTexture, Mesh, MeshBasicMaterial, PlaneGeometry, SRGBColorSpace, type Vector2 } from 'three';
import type { Overlay } from '../wire/messages';
import type { Words } from '../kiosk/words';

const kWidth = 1024;
const kHeight = 768;
const kAcross_m = 0.6;
const kMargin = 36;
const kButtonHigh = 84;

export interface BoardButton {
  action: string;
  text: string;
}
export interface BoardText {
  title: string;
  lines: string[];
  answers: BoardButton[];
  tools: BoardButton[];
}

/** What stands on it. Actions that begin with "xr:" are the headset's own. */
export function boardText(overlay: Overlay | null, words: Words, problem: string): BoardText {
  const { panel, notice } = overlay ?? { panel: null, notice: null };
  const lines = panel
    ? [panel.goal, panel.text, panel.more, panel.scale ? `${panel.low} – ${panel.high}` : '']
    : [notice ? `${notice.text} ${notice.more ?? ''}` : '', overlay?.goal, overlay?.caption, overlay?.hint, overlay?.subtitle];
  const answers = panel ? [...panel.answers, ...(panel.leave ? [panel.leave] : [])] : (overlay?.buttons ?? []);
  return {
    title: panel?.title || overlay?.title || '',
    lines: [problem, ...lines].filter((line): line is string => !!line?.trim()),
    answers: answers.map(({ action, text }) => ({ action, text })),
    tools: [
      { action: 'xr:recenter', text: words.recenter }, { action: 'xr:higher', text: '↑' }, { action: 'xr:lower', text: '↓' },
      { action: 'xr:left', text: '↺' }, { action: 'xr:right', text: '↻' }, { action: 'xr:leave', text: words.leaveHeadset },
    ],
  };
}

interface Area extends BoardButton {
  x: number;
  y: number;
  w: number;
  h: number;
}

export class Board {
  readonly mesh: Mesh;
  private readonly canvas = document.createElement('canvas');
  private readonly texture: CanvasTexture;
  private areas: Area[] = [];
  private drawn = '';

  constructor() {
    Object.assign(this.canvas, { width: kWidth, height: kHeight });
    this.texture = new CanvasTexture(this.canvas);
    this.texture.colorSpace = SRGBColorSpace;
    const material = new MeshBasicMaterial({ map: this.texture, toneMapped: false, transparent: true, fog: false });
    this.mesh = new Mesh(new PlaneGeometry(kAcross_m, (kAcross_m * kHeight) / kWidth), material);
    this.mesh.renderOrder = 5;
  }
  /** `at`: where on it a ray points; null: beside it. */
  buttonAt(at: Vector2 | null | undefined): string | null {
    if (!at) return null;
    const [x, y] = [at.x * kWidth, (1 - at.y) * kHeight];
    return this.areas.find((a) => x >= a.x && x <= a.x + a.w && y >= a.y && y <= a.y + a.h)?.action ?? null;
  }
  show(text: BoardText, pointed: string | null): void {
    const now = JSON.stringify([text, pointed]);
    if (now === this.drawn) return;
    this.drawn = now;
    this.draw(text, pointed);
    this.texture.needsUpdate = true;
  }
  dispose(): void {
    this.texture.dispose();
    this.mesh.geometry.dispose();
    (this.mesh.material as MeshBasicMaterial).dispose();
  }

  private draw(text: BoardText, pointed: string | null): void {
    const context = this.canvas.getContext('2d')!;
    context.clearRect(0, 0, kWidth, kHeight);
    context.fillStyle = 'rgb(20 22 26 / 88%)';
    context.beginPath();
    context.roundRect(0, 0, kWidth, kHeight, 28);
    context.fill();
    this.areas = [];
    let y = this.write(context, text.title, 'bold 44px sans-serif', '#f3c95a', kMargin + 40, 54);
    const tools = kHeight - kMargin - kButtonHigh;
    const answers = tools - 24 - text.answers.length * (kButtonHigh + 10);
    for (const line of text.lines) if (y < answers - 10) y = this.write(context, line, '36px sans-serif', '#f6f1e6', y + 8, 46);
    text.answers.forEach((button, k) => {
      this.button(context, button, { x: kMargin, y: answers + k * (kButtonHigh + 10), w: kWidth - 2 * kMargin }, pointed);
    });
    const wide = 250;
    const narrow = (kWidth - 2 * kMargin - 2 * wide - 50) / 4;
    let x = kMargin;
    for (const button of text.tools) {
      const w = button.text.length > 2 ? wide : narrow;
      this.button(context, button, { x, y: tools, w }, pointed);
      x += w + 10;
    }
  }
  private button(
    context: CanvasRenderingContext2D, button: BoardButton, at: { x: number; y: number; w: number }, pointed: string | null,
  ): void {
    context.fillStyle = button.action === pointed ? 'rgb(243 201 90 / 45%)' : 'rgb(255 255 255 / 12%)';
    context.beginPath();
    context.roundRect(at.x, at.y, at.w, kButtonHigh, 16);
    context.fill();
    context.fillStyle = '#fff';
    context.font = '34px sans-serif';
    context.textAlign = 'center';
    context.fillText(button.text, at.x + at.w / 2, at.y + kButtonHigh / 2 + 12, at.w - 20);
    context.textAlign = 'left';
    this.areas.push({ ...button, ...at, h: kButtonHigh });
  }
  /** In as many rows as it needs; returns where the next begins. */
  private write(context: CanvasRenderingContext2D, text: string, font: string, colour: string, y: number, high: number): number {
    context.font = font;
    context.fillStyle = colour;
    let row = '';
    for (const word of text.split(/\s+/)) {
      if (row && context.measureText(`${row} ${word}`).width > kWidth - 2 * kMargin) {
        context.fillText(row, kMargin, y);
        [row, y] = [word, y + high];
      } else row = row ? `${row} ${word}` : word;
    }
    context.fillText(row, kMargin, y);
    return y + high;
  }
}
