// A platform on a canvas: plates, legs and joints, far parts first.

/** The corners of the smallest convex outline of points on the page (Andrew's chain). */
function outline(points) {
  const sorted = [...points].sort((a, b) => a.x - b.x || a.y - b.y);
  const turn = (o, a, b) => (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
  const chain = (list) => {
    const out = [];
    for (const p of list) {
      while (out.length > 1 && turn(out[out.length - 2], out[out.length - 1], p) <= 0) out.pop();
      out.push(p);
    }
    return out.slice(0, -1);
  };
  return [...chain(sorted), ...chain(sorted.reverse())];
}

class View {
  constructor(canvas, camera, scene) {
    Object.assign(this, { canvas, camera, scene });
    camera.attach(canvas);
  }

  /** Draws a platform of the core, thin lines of the original's triangles, a ghost to compare with, and the singular positions. */
  draw(platform, { original, ghost, names, hardware, locus } = {}) {
    const { context, width, height } = fitted(this.canvas);
    if (!width || !platform) return;
    this.c = context;
    this.project = this.camera.projection(this.scene.centre, this.scene.radius, width, height);
    this.unit = this.scene.radius / 100;
    this.hardware = hardware;
    context.clearRect(0, 0, width, height);
    this.floor(platform);
    if (ghost) {
      context.globalAlpha = 0.6;
      this.body(ghost, { plain: true });
      context.globalAlpha = 1;
    }
    this.body(platform, { original, locus });
    if (names) this.names(platform);
  }

  line(a, b, colour, thickness, dash = []) {
    const c = this.c;
    c.beginPath();
    c.setLineDash(dash);
    c.moveTo(a.x, a.y);
    c.lineTo(b.x, b.y);
    c.strokeStyle = colour;
    c.lineWidth = thickness;
    c.lineCap = dash.length ? "butt" : "round";
    c.stroke();
    c.setLineDash([]);
  }

  /** A grid in the plane of the lowest base joint, for the sense of space. */
  floor(platform) {
    const [x0, y0] = this.scene.centre;
    const z = Math.min(...platform.base.map((j) => j.at[2])) - 2 * this.unit;
    const half = this.scene.radius * 1.15;
    for (let k = -4; k <= 4; k += 1) {
      const d = (k / 4) * half;
      const ends = [[[x0 + d, y0 - half, z], [x0 + d, y0 + half, z]], [[x0 - half, y0 + d, z], [x0 + half, y0 + d, z]]];
      for (const [a, b] of ends) this.line(this.project(a), this.project(b), style("--grid"), 1);
    }
  }

  body(platform, { original, plain, locus }) {
    const at = (joint) => this.project(joint.at);
    const used = (k) => [...new Set(platform.legs.map((l) => l[k]))];
    const plates = [[used(0).map((i) => at(platform.base[i])), "--base"], [used(1).map((i) => at(platform.platform[i])), "--platform"]];
    const mean = (list) => list.reduce((sum, p) => sum + p.depth, 0) / list.length;
    const parts = plates.map(([list, colour]) => ({ depth: mean(list), draw: () => this.plate(list, style(colour), plain) }));
    if (original) parts.push({ depth: Infinity, draw: () => this.triangles(original) });
    if (platform.cranks) parts.push(...Cranks.parts(this, platform, plain));
    else platform.legs.forEach(([a, b], k) => {
      const ends = [platform.base[a].at, platform.platform[b].at];
      parts.push({ depth: mean(ends.map(this.project)), draw: () => this.leg(ends, k + 1, plain) });
    });
    plates.forEach(([list, colour], body) => {
      for (const p of list) parts.push({ depth: p.depth - 4 * this.unit, draw: () => this.ball(p, style(colour), plain, this.hardware.joints[body]) });
    });
    if (locus) parts.push(...this.locus(locus));
    this.labels = [];
    parts.sort((p, q) => q.depth - p.depth).forEach((p) => p.draw());
    this.labels.forEach(([leg, p, size]) => this.number(leg, p, size));
  }

  /** Where the origin of the platform must not be with this orientation, the workspace as a box, and where the origin is. */
  locus({ surface, workspace, home, at }) {
    const parts = surfaceParts(surface, this.project, this.c);
    const ends = [-1, 1].map((sign) => home.map((x, k) => x + sign * workspace[k]));
    for (const [a, b] of boxEdges(...ends)) {
      const [p, q] = [a, b].map(this.project);
      parts.push({ depth: (p.depth + q.depth) / 2, draw: () => this.line(p, q, style("--ink"), 1, [3, 3]) });
    }
    const p = this.project(at);
    parts.push({ depth: p.depth - 4 * this.unit, draw: () => this.origin(p) });
    return parts;
  }

  /** The origin of the platform: a cross. */
  origin(p) {
    for (const [colour, thickness] of [[style("--halo"), 5], [style("--ink"), 2]]) {
      this.line({ x: p.x - 6, y: p.y }, { x: p.x + 6, y: p.y }, colour, thickness);
      this.line({ x: p.x, y: p.y - 6 }, { x: p.x, y: p.y + 6 }, colour, thickness);
    }
  }

  plate(points, colour, plain) {
    const c = this.c;
    c.beginPath();
    outline(points).forEach((p, k) => (k ? c.lineTo(p.x, p.y) : c.moveTo(p.x, p.y)));
    c.closePath();
    c.globalAlpha *= plain ? 0.25 : 0.42;
    c.fillStyle = colour;
    c.fill();
    c.globalAlpha /= plain ? 0.25 : 0.42;
    c.strokeStyle = colour;
    c.lineJoin = "round";
    c.lineWidth = plain ? 1 : 2.2;
    c.setLineDash(plain ? [4, 4] : []);
    c.stroke();
    c.setLineDash([]);
  }

  /** The sides along which joints slide. */
  triangles(original) {
    for (const [part, k] of [["base", 0], ["platform", 1]]) {
      const joints = [...new Set(original.legs.map((l) => l[k]))].map((i) => this.project(original[part][i].at));
      joints.forEach((p, i) => this.line(p, joints[(i + 1) % joints.length], style("--ghost"), 1.1, [3, 4]));
    }
  }

  /** Cylinder and rod, as long and as thick as the design says, else by a share of the picture. */
  leg([a, b], leg, plain) {
    const { leg: diameter, rod } = this.hardware;
    const whole = Math.hypot(...a.map((x, k) => b[k] - x));
    const share = rod ? Math.min(1, rod[0] / whole) : diameter ? 1 : 0.52;
    const mid = a.map((x, k) => x + share * (b[k] - x));
    const [p, m, q] = [a, mid, b].map(this.project);
    if (plain) {
      this.line(p, q, style("--ghost"), 1.4, [5, 4]);
      return;
    }
    const colour = style(`--leg-${leg}`);
    const thick = Math.max(1.5, diameter ? diameter * m.pixels : Math.max(2.5, 4.6 * this.unit * m.pixels));
    const thin = rod ? Math.max(1, rod[1] * m.pixels) : 0.5 * thick;
    this.line(m, q, style("--halo"), thin + 2);
    this.line(p, m, style("--halo"), thick + 2);
    this.line(m, q, colour, thin);
    this.line(p, m, colour, thick);
    this.labels.push([leg, { x: p.x + 0.32 * (q.x - p.x), y: p.y + 0.32 * (q.y - p.y) }, Math.min(20, Math.max(9, 0.95 * thick + 4))]);
  }

  number(leg, p, size) {
    const c = this.c;
    c.font = `600 ${size}px system-ui,sans-serif`;
    c.textAlign = "center";
    c.textBaseline = "middle";
    c.lineWidth = 3;
    c.strokeStyle = style("--halo");
    c.strokeText(leg, p.x, p.y);
    c.fillStyle = style("--ink");
    c.fillText(leg, p.x, p.y);
  }

  ball(p, colour, plain, diameter) {
    if (plain) return;
    const r = Math.max(2.6, diameter ? (diameter / 2) * p.pixels : 3.4 * this.unit * p.pixels);
    const shade = this.c.createRadialGradient(p.x - r / 3, p.y - r / 3, r / 6, p.x, p.y, r);
    shade.addColorStop(0, "#ffffff");
    shade.addColorStop(0.45, colour);
    shade.addColorStop(1, "#20262d");
    this.c.beginPath();
    this.c.arc(p.x, p.y, r, 0, 2 * Math.PI);
    this.c.fillStyle = shade;
    this.c.fill();
  }

  names(platform) {
    const c = this.c;
    c.font = "600 12px system-ui,sans-serif";
    c.textAlign = "left";
    c.textBaseline = "bottom";
    for (const joint of [...platform.base, ...platform.platform]) {
      const p = this.project(joint.at);
      c.lineWidth = 3.5;
      c.strokeStyle = style("--halo");
      c.strokeText(joint.name, p.x + 6, p.y - 4);
      c.fillStyle = style("--ink");
      c.fillText(joint.name, p.x + 6, p.y - 4);
    }
  }
}
