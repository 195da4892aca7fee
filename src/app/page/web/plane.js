// det A over two offsets: signs as tints, the line on which it vanishes, where the workspace is not feasible, the current point.

/** Where requirements are violated: points a side and points of the workspace, a quick check first. */
const SHADE = { rough: { points: 21, samples: 30 }, fine: { points: 61, samples: 250 } };
/** Pixels between two lines of the hatching. */
const HATCH = 7;

const PLANE = { low: -0.5, high: 1.5, points: 61, left: 52, right: 10, top: 10, bottom: 36 };

class Plane {
  constructor(canvas, words, set) {
    Object.assign(this, { canvas, words, set, axes: [0, 1] });
    const drag = (e) => {
      if (!this.enabled || !(e.buttons & 1)) return;
      const box = canvas.getBoundingClientRect();
      this.move([this.value(e.clientX - box.left, 0), this.value(e.clientY - box.top, 1)].map((t) => Number(t.toFixed(3))));
    };
    canvas.addEventListener("pointerdown", (e) => {
      canvas.setPointerCapture(e.pointerId);
      drag(e);
    });
    canvas.addEventListener("pointermove", drag);
    canvas.addEventListener("keydown", (e) => this.key(e));
  }

  key(e) {
    const step = e.shiftKey ? 0.1 : 0.01;
    const moves = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
    if (!this.enabled || !moves[e.key]) return;
    e.preventDefault();
    this.move(this.axes.map((k, i) => Number((this.offsets[k] + moves[e.key][i]).toFixed(6))));
  }

  move(values) {
    this.set(this.axes.map((k, i) => [k, Math.max(PLANE.low, Math.min(PLANE.high, values[i]))]));
  }

  scaleOf(axis) {
    const { left, right, top, bottom } = PLANE;
    return axis === 0 ? [left, this.width - right] : [this.height - bottom, top];
  }

  place(t, axis) {
    const [from, to] = this.scaleOf(axis);
    return from + ((t - PLANE.low) / (PLANE.high - PLANE.low)) * (to - from);
  }

  value(pixels, axis) {
    const [from, to] = this.scaleOf(axis);
    const t = PLANE.low + ((pixels - from) / (to - from)) * (PLANE.high - PLANE.low);
    return Math.max(PLANE.low, Math.min(PLANE.high, t));
  }

  /** Shows answers of the core: det A, and where requirements are violated. */
  draw(plane, feasible, { pattern, offsets, det }) {
    Object.assign(this, { plane, pattern, offsets });
    const { context: c, width, height } = fitted(this.canvas);
    Object.assign(this, { width, height });
    if (!width || !plane || plane.error) return;
    c.clearRect(0, 0, width, height);
    this.tint(c);
    if (feasible && !feasible.error) this.hatch(c, feasible);
    this.frame(c);
    c.lineWidth = 2.6;
    c.strokeStyle = style("--bad");
    for (const line of plane.zero) {
      c.beginPath();
      line.forEach(([x, y], k) => (k ? c.lineTo(this.place(x, 0), this.place(y, 1)) : c.moveTo(this.place(x, 0), this.place(y, 1))));
      c.stroke();
    }
    this.mark(c);
    const [i, j] = this.axes.map((k) => pattern.offsets[k].name);
    const [x, y] = this.axes.map((k) => show(offsets[k]));
    this.words.textContent = `The mark is at ${i} = ${x}, ${j} = ${y}, where det A = ${show(det)}. On the heavy line det A = 0; plus and minus show its sign. `
      + (plane.zero.length ? "" : "There is no such line in this square.");
  }

  tint(c) {
    const n = this.plane.points;
    const step = (this.scaleOf(0)[1] - this.scaleOf(0)[0]) / (n - 1);
    const rise = (this.scaleOf(1)[0] - this.scaleOf(1)[1]) / (n - 1);
    // one pixel a value, drawn larger; the middle of a pixel is its place
    c.drawImage(this.pixels(n), 0.5, 0.5, n - 1, n - 1, this.scaleOf(0)[0], this.scaleOf(1)[1], step * (n - 1), rise * (n - 1));
    c.globalAlpha = 0.75;
    c.fillStyle = style("--ink");
    c.font = "13px system-ui,sans-serif";
    c.textAlign = "center";
    c.textBaseline = "middle";
    const every = Math.round((n - 1) / 6);
    for (let row = every; row + 1 < n; row += every) {
      for (let column = every; column + 1 < n; column += every) {
        const value = this.plane.values[row * n + column];
        if (value !== 0) c.fillText(value > 0 ? "+" : "−", this.scaleOf(0)[0] + column * step, this.scaleOf(1)[0] - row * rise);
      }
    }
    c.globalAlpha = 1;
  }

  /** Lines over the platforms that violate a requirement somewhere in the workspace, and an edge around those that were not found to. */
  hatch(c, { points: n, violated }) {
    const [x, y] = [0, 1].map((axis) => this.scaleOf(axis));
    const step = [0, 1].map((axis) => (this.scaleOf(axis)[1] - this.scaleOf(axis)[0]) / (n - 1));
    const bad = (column, row) => violated[row * n + column] !== null;
    const corner = (k, axis) => this.scaleOf(axis)[0] + Math.max(0, Math.min(n - 1, k - 0.5)) * step[axis];
    c.save();
    c.beginPath();
    for (let row = 0; row < n; row += 1) {
      for (let column = 0; column < n; column += 1) {
        if (bad(column, row)) c.rect(corner(column, 0), corner(row, 1), corner(column + 1, 0) - corner(column, 0), corner(row + 1, 1) - corner(row, 1));
      }
    }
    c.clip();
    c.globalAlpha = 0.45;
    c.fillStyle = style("--card");
    c.fillRect(x[0], y[1], x[1] - x[0], y[0] - y[1]);
    c.strokeStyle = style("--soft");
    c.lineWidth = 1;
    c.beginPath();
    const high = y[0] - y[1];
    for (let from = x[0] - high; from < x[1]; from += HATCH) {
      c.moveTo(from, y[0]);
      c.lineTo(from + high, y[1]);
    }
    c.stroke();
    c.restore();
    c.beginPath();
    for (let row = 0; row < n; row += 1) {
      for (let column = 0; column < n; column += 1) {
        if (column && bad(column, row) !== bad(column - 1, row)) {
          c.moveTo(corner(column, 0), corner(row, 1));
          c.lineTo(corner(column, 0), corner(row + 1, 1));
        }
        if (row && bad(column, row) !== bad(column, row - 1)) {
          c.moveTo(corner(column, 0), corner(row, 1));
          c.lineTo(corner(column + 1, 0), corner(row, 1));
        }
      }
    }
    c.strokeStyle = style("--good");
    c.lineWidth = 2;
    c.stroke();
  }

  /** The requirements on the platforms of the plane, and on the platform next to the mark, in words. */
  static words(feasible, at) {
    if (!feasible) return "Checking requirements ..";
    if (feasible.error) return feasible.error.code === "nothing_required" ? "" : feasible.error.message;
    const { points: n, low, high, poses, violated } = feasible;
    const where = `at one of ${poses} poses of the workspace`;
    const free = violated.some((kind) => kind === null);
    const kinds = [...new Set(violated)].filter(Boolean).join("; ");
    const all = !kinds ? `No requirement is violated ${where}.` : free
      ? `Hatched: a requirement (${kinds}) is violated ${where}; inside the green line none is.`
      : `Hatched: everywhere in this square a requirement (${kinds}) is violated ${where}.`;
    const [column, row] = at.map((t) => Math.round(((t - low) / (high - low)) * (n - 1)));
    if ([column, row].some((k) => k < 0 || k >= n)) return `${all} The mark is outside.`;
    const here = violated[row * n + column];
    const next = here ? `violates: ${here}` : "violates none at these poses; the assessment at the top of the page proves it for the mark";
    return `${all} The platform next to the mark ${next}.`;
  }

  pixels(n) {
    const small = Object.assign(document.createElement("canvas"), { width: n, height: n });
    const c = small.getContext("2d");
    const top = Math.max(...this.plane.values.map(Math.abs)) || 1;
    const tints = [style("--positive"), style("--negative")];
    this.plane.values.forEach((value, k) => {
      c.globalAlpha = 0.08 + 0.5 * Math.pow(Math.abs(value) / top, 0.25);
      c.fillStyle = tints[value > 0 ? 0 : 1];
      c.fillRect(k % n, n - 1 - Math.floor(k / n), 1, 1);
    });
    return small;
  }

  frame(c) {
    const [[x0, x1], [y0, y1]] = [this.scaleOf(0), this.scaleOf(1)];
    c.strokeStyle = style("--soft");
    c.lineWidth = 1;
    c.strokeRect(x0, y1, x1 - x0, y0 - y1);
    c.fillStyle = style("--ink");
    c.font = "12px system-ui,sans-serif";
    for (const t of [-0.5, 0, 0.5, 1, 1.5]) {
      const [x, y] = [this.place(t, 0), this.place(t, 1)];
      c.textAlign = "center";
      c.textBaseline = "top";
      c.fillText(String(t).replace("-", "−"), x, y0 + 5);
      c.textAlign = "right";
      c.textBaseline = "middle";
      c.fillText(String(t).replace("-", "−"), x0 - 6, y);
      if (t !== 0 && t !== 1) continue;
      c.setLineDash([2, 4]);
      c.beginPath();
      c.moveTo(x, y0);
      c.lineTo(x, y1);
      c.moveTo(x0, y);
      c.lineTo(x1, y);
      c.stroke();
      c.setLineDash([]);
    }
    const [i, j] = this.axes.map((k) => this.pattern.offsets[k].name);
    c.font = "italic 600 13px system-ui,sans-serif";
    c.textAlign = "center";
    c.textBaseline = "bottom";
    c.fillText(i, (x0 + x1) / 2, this.height);
    c.textAlign = "left";
    c.textBaseline = "middle";
    c.fillText(j, 2, (y0 + y1) / 2);
  }

  mark(c) {
    const [x, y] = this.axes.map((k, axis) => this.place(this.offsets[k], axis));
    c.beginPath();
    c.arc(x, y, 6, 0, 2 * Math.PI);
    c.fillStyle = style("--ink");
    c.fill();
    c.lineWidth = 2.5;
    c.strokeStyle = style("--card");
    c.stroke();
  }
}
