// Rods on cranks: the circles of the tips, cranks and rods, and their angles.

/** Corners of the drawn circle of a crank. */
const CIRCLE = 40;

const Cranks = {
  /** The angles kept, degrees; `null` where a rod does not reach. */
  angles(platform) {
    const { list } = platform.cranks;
    return list.length ? list.map((c) => c.angle_deg) : null;
  },

  /** What is drawn: the circle of each tip, the crank and its rod, and the crank on its other side, dashed. */
  parts(view, platform, plain) {
    const { arms, list } = platform.cranks;
    const depth = (points) => points.reduce((sum, p) => sum + p.depth, 0) / points.length;
    return platform.legs.flatMap(([a, b], k) => {
      const centre = platform.base[a].at;
      const circle = Array.from({ length: CIRCLE + 1 }, (_, j) => {
        const [c, s] = [Math.cos((2 * Math.PI * j) / CIRCLE), Math.sin((2 * Math.PI * j) / CIRCLE)];
        return view.project(centre.map((x, i) => x + c * arms[k][0][i] + s * arms[k][1][i]));
      });
      const ring = { depth: depth(circle) + view.unit, draw: () => circle.slice(1).forEach((p, j) => view.line(circle[j], p, style("--ghost"), 1)) };
      if (!list.length) return plain ? [] : [ring];
      const end = platform.platform[b].at;
      const [from, tip, to] = [centre, list[k].tip, end].map(view.project);
      const other = view.project(list[k].other_tip);
      const rod = { depth: depth([tip, to]), draw: () => Cranks.rod(view, [tip, to], k + 1, plain) };
      const crank = { depth: depth([from, tip]), draw: () => Cranks.crank(view, [from, tip], k + 1, plain) };
      if (plain) return [rod, crank];
      const dashed = {
        depth: depth([from, other, to]) + view.unit,
        draw: () => [[from, other], [other, to]].forEach(([p, q]) => view.line(p, q, style("--ghost"), 1.2, [3, 4])),
      };
      return [ring, dashed, rod, crank];
    });
  },

  rod(view, [p, q], leg, plain) {
    if (plain) {
      view.line(p, q, style("--ghost"), 1.4, [5, 4]);
      return;
    }
    const thick = Math.max(1.5, 2.2 * view.unit * p.pixels);
    view.line(p, q, style("--halo"), thick + 2);
    view.line(p, q, style(`--leg-${leg}`), thick);
    view.labels.push([leg, { x: p.x + 0.45 * (q.x - p.x), y: p.y + 0.45 * (q.y - p.y) }, Math.min(20, Math.max(9, 1.9 * thick + 4))]);
  },

  crank(view, [p, q], leg, plain) {
    if (plain) {
      view.line(p, q, style("--ghost"), 2.2, [5, 4]);
      return;
    }
    const thick = Math.max(2.5, 4.6 * view.unit * p.pixels);
    view.line(p, q, style("--halo"), thick + 2);
    view.line(p, q, style(`--leg-${leg}`), thick);
    view.ball(q, style("--base"), false, 0);
  },

  /** Both angles of each crank, the kept one first, and how it stands. */
  table({ list, out_of_reach: missing }, units) {
    $("map-details").hidden = true;
    $("lengths-words").textContent = missing ? `${Cranks.missing(missing, units)} There are no angles at this pose.`
      : "Both angles hold the platform. The first one is on the elbow side of the design; the other one is dashed in the picture. At a transmission of 0 both coincide, and the crank is singular.";
    const rows = list.map((c, k) => row([legName(k + 1), [el("b", {}, `${show(c.angle_deg, 6)} ●`), el("small", {}, `${c.elbow}, design`)], show(c.other_angle_deg, 6),
      c.limit_margin_deg === null ? "no limits" : el("span", { class: c.limit_margin_deg < 0 ? "bad" : null }, show(c.limit_margin_deg, 4)), show(c.transmission, 4), show(c.to_singular_deg, 4)]));
    $("lengths").replaceChildren(...(rows.length ? [heading(["", "angle [°]", "other side [°]", "to its limit [°]", "trans\u00admission", "to singular [°]"]), el("tbody", {}, ...rows)] : []));
  },

  missing: ({ leg, too_short_by: by }, units) => `The rod of leg ${leg} is ${show(Math.abs(by), 4)}${unit(units)} too ${by > 0 ? "short" : "long"} to reach from its crank to the platform.`,

  /** The chip of the picture. */
  reached({ out_of_reach: missing, list }) {
    if (missing) return ["bad", `rod ${missing.leg} does not reach`];
    return list.some((c) => c.limit_margin_deg !== null && c.limit_margin_deg < 0) ? ["bad", "a crank is beyond its limits"] : ["good", "all rods reach"];
  },

  tiles({ list }) {
    const least = (of) => (list.length ? Math.min(...list.map(of)) : null);
    const size = least((c) => Math.abs(c.transmission));
    return [
      { name: "transmission angle [°]", id: "transmission", value: show(size === null ? null : (Math.asin(Math.min(1, size)) * 180) / Math.PI, 4), unit: "least of all cranks; 0 singular" },
      { name: "to a singular crank [°]", id: "to-singular", value: show(least((c) => c.to_singular_deg), 4), unit: "least of all cranks" },
    ];
  },
};
