// Surfaces of triangles in a picture, far ones first, and det A = 0 over three offsets.

/** Points a side at which the core searches for a surface. */
const SURFACE = { points: 25 };

/** A colour of the style sheet in red, green and blue. */
const rgb = (name) => [1, 3, 5].map((k) => parseInt(style(name).slice(k, k + 2), 16));

/** The triangles of a surface of the core as parts of a picture: darker where they are seen from the side. */
function surfaceParts(surface, project, context) {
  const { vertices, triangles } = surface;
  const [colour, paper] = [rgb("--bad"), rgb("--card")];
  const flat = vertices.map(project);
  return triangles.map((corners) => {
    const [a, b, c] = corners.map((k) => vertices[k]);
    const [u, v] = [b, c].map((p) => p.map((x, k) => x - a[k]));
    const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const [p, q, r] = corners.map((k) => flat[k]);
    // how much of the triangle faces the light from above
    const light = Math.abs(normal[2]) / (Math.hypot(...normal) || 1);
    const share = 0.3 + 0.45 * (1 - light);
    const fill = `rgb(${colour.map((x, k) => Math.round(share * x + (1 - share) * paper[k])).join(",")})`;
    const draw = () => {
      context.globalAlpha = 0.8;
      context.beginPath();
      context.moveTo(p.x, p.y);
      context.lineTo(q.x, q.y);
      context.lineTo(r.x, r.y);
      context.closePath();
      context.fillStyle = fill;
      context.fill();
      // without a line there would be gaps between neighbours
      context.lineWidth = 0.6;
      context.strokeStyle = fill;
      context.stroke();
      context.globalAlpha = 1;
    };
    return { depth: (p.depth + q.depth + r.depth) / 3, draw };
  });
}

/** The twelve edges of a box between two corners. */
function boxEdges(low, high) {
  const corner = (k) => [0, 1, 2].map((axis) => (k & (1 << axis) ? high[axis] : low[axis]));
  const pairs = [];
  for (let k = 0; k < 8; k += 1) for (let axis = 0; axis < 3; axis += 1) if (!(k & (1 << axis))) pairs.push([corner(k), corner(k | (1 << axis))]);
  return pairs;
}

class Space {
  constructor(canvas, words) {
    Object.assign(this, { canvas, words, axis: 2 });
    this.camera = new Camera(() => this.paint());
    this.camera.attach(canvas);
  }

  /** Shows an answer of the core for the axes of the plane and a third one. */
  draw(surface, pattern, { axes, offsets, det }) {
    Object.assign(this, { surface, pattern, axes, offsets });
    this.paint();
    if (!surface || surface.error) return;
    const names = axes.map((k) => pattern.offsets[k].name);
    this.words.textContent = surface.triangles.length
      ? `On the surface det A = 0 over ${names.join(", ")}, the other offsets as they are. The mark is the platform shown, where det A = ${show(det)}; the dashed square is the plane above.`
      : `det A is not zero in this cube over ${names.join(", ")}, the other offsets as they are.`;
  }

  paint() {
    const { surface, canvas } = this;
    const { context: c, width, height } = fitted(canvas);
    if (!width || !surface || surface.error) return;
    c.clearRect(0, 0, width, height);
    const { low, high } = surface;
    const centre = low.map((x, k) => (x + high[k]) / 2);
    const project = this.camera.projection(centre, 0.94 * Math.hypot(...high.map((x, k) => x - centre[k])), width, height);
    const line = (a, b, colour, thickness, dash = []) => {
      const [p, q] = [a, b].map(project);
      c.beginPath();
      c.setLineDash(dash);
      c.moveTo(p.x, p.y);
      c.lineTo(q.x, q.y);
      c.strokeStyle = colour;
      c.lineWidth = thickness;
      c.stroke();
      c.setLineDash([]);
    };
    for (const [a, b] of boxEdges(low, high)) line(a, b, style("--soft"), 1);
    const parts = surfaceParts(surface, project, c);
    const at = this.axes.map((k) => this.offsets[k]);
    if (at.every((x, k) => x >= low[k] && x <= high[k])) {
      const corners = [[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]].map(([x, y]) => [x, y, at[2]]);
      corners.forEach((p, k) => {
        const q = corners[(k + 1) % 4];
        parts.push({ depth: (project(p).depth + project(q).depth) / 2, draw: () => line(p, q, style("--ink"), 1.2, [5, 4]) });
      });
      const mark = project(at);
      parts.push({ depth: project([at[0], at[1], (low[2] + at[2]) / 2]).depth, draw: () => line([at[0], at[1], low[2]], at, style("--ink"), 1, [2, 3]) });
      parts.push({ depth: mark.depth - 0.05, draw: () => this.mark(c, mark) });
    }
    parts.sort((p, q) => q.depth - p.depth).forEach((p) => p.draw());
    this.label(c, project);
  }

  mark(c, p) {
    c.beginPath();
    c.arc(p.x, p.y, 6, 0, 2 * Math.PI);
    c.fillStyle = style("--ink");
    c.fill();
    c.lineWidth = 2.5;
    c.strokeStyle = style("--card");
    c.stroke();
  }

  /** Names and ends of the axes, on the edges through the first corner. */
  label(c, project) {
    const { low, high } = this.surface;
    const write = (text, at, font) => {
      const p = project(at);
      c.font = font;
      c.textAlign = "center";
      c.textBaseline = "middle";
      c.lineWidth = 4;
      c.strokeStyle = style("--card");
      c.strokeText(text, p.x, p.y);
      c.fillStyle = style("--ink");
      c.fillText(text, p.x, p.y);
    };
    this.axes.forEach((offset, axis) => {
      const on = (t, away) => low.map((x, k) => (k === axis ? x + t * (high[k] - x) : x - away * (high[k] - x)));
      write(this.pattern.offsets[offset].name, on(0.5, 0.12), "italic 600 13px system-ui,sans-serif");
      for (const t of [0.25, 0.75]) write(fixed(low[axis] + t * (high[axis] - low[axis]), 0), on(t, 0.06), "12px system-ui,sans-serif");
    });
  }
}
