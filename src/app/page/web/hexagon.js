// The hexagon of legs: a slider for every moved leg, on its side.

const HEX = { radius: 108, low: -0.5, high: 1.5 };

class Hexagon {
  /** `set(k, t)` moves offset k. */
  constructor(svg, set) {
    this.svg = svg;
    this.set = set;
    this.corners = Array.from({ length: 6 }, (_, k) => {
      const angle = (-90 - 30 + 60 * k) * (Math.PI / 180);
      return [HEX.radius * Math.cos(angle), HEX.radius * Math.sin(angle)];
    });
  }

  /** The point of side k at the fraction t. */
  at(k, t) {
    const [a, b] = [this.corners[k], this.corners[(k + 1) % 6]];
    return [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
  }

  /** The fraction at which side k is closest to a point. */
  fraction(k, [x, y]) {
    const [a, b] = [this.corners[k], this.corners[(k + 1) % 6]];
    const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    return ((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy);
  }

  /** Draws everything for another pattern. */
  build(hexagon, pattern, enabled) {
    this.enabled = enabled;
    const legs = pattern.legs;
    const lines = hexagon.sides.flatMap((side, k) => this.side(side, k));
    const corners = hexagon.vertices.map((vertex, k) => this.corner(vertex, k, legs.some((l) => l.vertex === k)));
    this.handles = pattern.offsets.map((offset, k) => {
      const leg = legs.find((l) => l.offset === k);
      return this.handle(offset, k, leg, hexagon.sides[offset.side]);
    });
    this.svg.replaceChildren(...lines, ...this.handles.map((h) => h.zero), ...corners, ...this.handles.map((h) => h.node));
    this.pattern = pattern;
  }

  side(side, k) {
    const line = (from, to, kind) => {
      const [a, b] = [this.at(k, from), this.at(k, to)];
      return el("line", { x1: a[0], y1: a[1], x2: b[0], y2: b[1], class: kind });
    };
    const [x, y] = this.at(k, 0.5);
    const out = 0.74;
    const label = el("text", { x: x * out, y: y * out, class: "soft", "text-anchor": "middle", "dominant-baseline": "middle" }, side.fixed);
    label.append(el("title", {}, `these legs share ${side.fixed}; their other ends lie on ${side.from}${side.to} (${side.body})`));
    return [line(HEX.low, 0, "beyond"), line(1, HEX.high, "beyond"), line(0, 1, "side"), label];
  }

  corner(vertex, k, kept) {
    const [x, y] = this.corners[k];
    const colour = legColour(vertex.leg);
    return el("g", {},
      el("title", {}, `leg ${vertex.leg}: ${vertex.joints.join(" – ")}, ${kept ? "kept" : "replaced"}`),
      el("circle", { cx: x, cy: y, r: 13, class: "corner", style: `stroke:${colour};${kept ? `fill:${colour}` : ""}` }),
      el("text", { x, y: y + 0.5, "text-anchor": "middle", "dominant-baseline": "middle", "font-weight": 600 }, String(vertex.leg)));
  }

  handle(offset, k, leg, side) {
    const colour = legColour(leg.leg);
    const node = el("g", {
      class: "handle", role: "slider", tabindex: this.enabled ? 0 : -1, "aria-valuemin": HEX.low, "aria-valuemax": HEX.high,
      "aria-disabled": this.enabled ? null : "true", "aria-label": `${offset.name}, joint ${offset.joint} of leg ${leg.leg} on ${side.from}${side.to}`,
      keydown: (e) => this.key(e, k), pointerdown: (e) => this.enabled && e.currentTarget.setPointerCapture(e.pointerId),
      pointermove: (e) => this.dragged(e, k),
    },
    el("circle", { class: "touch", r: 22 }), el("circle", { class: "ring", r: 14 }),
    el("circle", { r: 9, style: `fill:${colour};stroke:var(--card);stroke-width:2` }),
    el("text", { ...this.beside(offset), "text-anchor": "middle", "dominant-baseline": "middle" }, offset.name));
    const [a, b] = [this.at(offset.side, 0), this.at(offset.side, 1)];
    const across = [(a[1] - b[1]) / HEX.radius * 20, (b[0] - a[0]) / HEX.radius * 20];
    const zero = el("line", { class: "zero", x1: -across[0], y1: -across[1], x2: across[0], y2: across[1] });
    zero.append(el("title", {}, `det A = 0 for this value of ${offset.name}`));
    return { node, zero, side: offset.side };
  }

  /** Where the name of a point stands: outside of its side. */
  beside(offset) {
    const [x, y] = this.at(offset.side, 0.5);
    return { x: (x / Math.hypot(x, y)) * 23, y: (y / Math.hypot(x, y)) * 23 };
  }

  key(e, k) {
    const step = e.shiftKey ? 0.1 : 0.01;
    const moves = { ArrowLeft: -step, ArrowDown: -step, ArrowRight: step, ArrowUp: step, PageUp: 0.1, PageDown: -0.1 };
    if (!this.enabled || !(e.key in moves)) return;
    e.preventDefault();
    this.set(k, Number((this.offsets[k] + moves[e.key]).toFixed(6)));
  }

  dragged(e, k) {
    if (!this.enabled || !e.currentTarget.hasPointerCapture(e.pointerId)) return;
    const matrix = this.svg.getScreenCTM().inverse();
    const p = new DOMPoint(e.clientX, e.clientY).matrixTransform(matrix);
    const t = this.fraction(this.pattern.offsets[k].side, [p.x, p.y]);
    this.set(k, Number(Math.max(HEX.low, Math.min(HEX.high, t)).toFixed(3)));
  }

  /** Moves the points, and the crosses where det A vanishes. */
  update(offsets, zeros) {
    this.offsets = offsets;
    this.handles.forEach((handle, k) => {
      const shown = Math.max(HEX.low, Math.min(HEX.high, offsets[k]));
      handle.node.setAttribute("transform", `translate(${this.at(handle.side, shown).join(" ")})`);
      handle.node.setAttribute("aria-valuenow", offsets[k]);
      handle.node.setAttribute("aria-valuetext", show(offsets[k]));
      const zero = zeros ? zeros[k] : null;
      const visible = zero !== null && zero >= HEX.low && zero <= HEX.high;
      handle.zero.setAttribute("visibility", visible ? "visible" : "hidden");
      if (visible) handle.zero.setAttribute("transform", `translate(${this.at(handle.side, zero).join(" ")})`);
    });
  }
}
