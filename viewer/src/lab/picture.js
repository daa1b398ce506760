// A canvas that is painted anew when it has another size, sharp on any screen.
import { colour, element } from "../theme.js";

export class Picture {
  /** `height(width)` in px; `paint(context, width, height)`. */
  constructor(label, className, height, paint) {
    Object.assign(this, { height, paint });
    this.element = element("canvas", { class: className, role: "img", "aria-label": label });
    new ResizeObserver(() => this.repaint()).observe(this.element);
  }

  label(text) {
    this.element.setAttribute("aria-label", text);
  }

  repaint() {
    const { element: canvas } = this, width = canvas.clientWidth, ratio = Math.min(devicePixelRatio, 3);
    if (width === 0) return;
    const height = this.height(width);
    canvas.style.height = `${height}px`;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const context = canvas.getContext("2d");
    context.scale(ratio, ratio);
    context.lineJoin = context.lineCap = "round";
    this.paint(context, width, height);
  }
}

export function write(context, text, x, y, { align = "left", css = "--soft", size = 12, weight = 450 } = {}) {
  context.font = `${weight} ${size}px ${colour("--sans")}`;
  context.fillStyle = colour(css);
  context.textAlign = align;
  context.textBaseline = "middle";
  context.fillText(text, x, y);
}

/** Words in as many lines as `width` needs, around `y`. */
export function writeLines(context, text, x, y, width, style) {
  const { size = 12, weight = 450 } = style, lines = [];
  context.font = `${weight} ${size}px ${colour("--sans")}`;
  for (const word of text.split(" ")) {
    const longer = lines.length ? `${lines.at(-1)} ${word}` : word;
    if (lines.length && context.measureText(longer).width <= width) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  lines.forEach((one, i) => write(context, one, x, y + (i - (lines.length - 1) / 2) * 1.4 * size, style));
}

export function line(context, points, css, width, dash = []) {
  context.beginPath();
  for (const [x, y] of points) context.lineTo(x, y);
  context.strokeStyle = colour(css);
  context.lineWidth = width;
  context.setLineDash(dash);
  context.stroke();
  context.setLineDash([]);
}
