// The strip above the slider: the footfalls of the whole recording, and which part the diagrams show.
import { colour, legColour } from "./theme.js";

export class Overview {
  constructor(canvas, window, clock) {
    Object.assign(this, { canvas, window, clock });
    this.picture = document.createElement("canvas");
    new ResizeObserver(() => this.repaint()).observe(canvas);
  }

  setWalk(walk) {
    this.walk = walk;
    this.repaint();
  }

  repaint() {
    if (!this.walk) return;
    this.picture.width = this.canvas.width = Math.round(this.canvas.clientWidth * devicePixelRatio);
    this.picture.height = this.canvas.height = Math.round(this.canvas.clientHeight * devicePixelRatio);
    if (this.picture.width === 0) return;
    const paint = this.picture.getContext("2d");
    const { width, height } = this.picture;
    const row = height / this.walk.robot.legs.length, scale = width / (this.clock.duration_s || 1);
    this.walk.stances.forEach((stances, leg) => {
      paint.fillStyle = legColour(leg);
      for (const [start_s, end_s] of stances)
        paint.fillRect(start_s * scale, leg * row + 0.18 * row, (end_s - start_s) * scale, 0.64 * row);
    });
    this.show();
  }

  show() {
    const { width, height } = this.canvas;
    if (!this.walk || width === 0) return;
    const paint = this.canvas.getContext("2d");
    const scale = width / (this.clock.duration_s || 1);
    paint.clearRect(0, 0, width, height);
    paint.globalAlpha = 0.4;
    paint.drawImage(this.picture, 0, 0);
    const from = this.window.start(this.clock.time_s) * scale, wide = this.window.span_s * scale;
    paint.save();
    paint.beginPath();
    paint.rect(from, 0, wide, height);
    paint.clip();
    paint.globalAlpha = 1;
    paint.drawImage(this.picture, 0, 0);
    paint.restore();
    if (wide < width - 1) {
      paint.strokeStyle = colour("--line");
      paint.lineWidth = devicePixelRatio;
      paint.strokeRect(from, 0, wide, height);
    }
  }
}
