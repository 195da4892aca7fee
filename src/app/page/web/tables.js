// Numbers in tables: the text alternative of every picture.

/** The quantity of each margin, in words. */
const REQUIREMENTS = {
  min_leg_length: "legs, above the least length", max_leg_length: "legs, below the greatest length",
  base_cone_angle: "cone angle of the base joints", platform_cone_angle: "cone angle of the platform joints",
  base_first_angle: "angle about the first axes, base joints", base_second_angle: "angle about the second axes, base joints",
  platform_first_angle: "angle about the first axes, platform joints",
  platform_second_angle: "angle about the second axes, platform joints",
  min_rod_length: "rods, long enough to reach", max_rod_length: "rods, short enough to close", crank_transmission: "trans\u00admission angle of the cranks",
  crank_angle: "angle of the cranks", tip_angle: "lean of the rods at the tips", crank_torque: "torque of the cranks", crank_speed: "speed of the cranks",
  leg_clearance: "gap between legs", keep_out: "gap to the keep-outs", leg_force: "leg force", leg_speed: "leg speed",
  base_spacing: "gap between base joints", platform_spacing: "gap between platform joints",
};

const Tables = {
  /** Leg lengths of both platforms, with what the leg map makes of the first ones. */
  lengths(state, units) {
    const [first, second] = state.platforms;
    const map = state.map;
    const joints = (p, k) => el("small", {}, `${p.base[p.legs[k][0]].name} – ${p.platform[p.legs[k][1]].name}`);
    const rows = first.lengths.map((length, k) => {
      const cells = [legName(k + 1), [show(length, 8), joints(first, k)]];
      if (map) cells.push([show(second.lengths[k], 8), joints(second, k)], show(Math.sqrt(map.image[k]), 8));
      return row(cells);
    });
    const heads = map ? ["", `original${inUnits(units)}`, `equivalent${inUnits(units)}`, "√(A s + c)"] : ["", `length${inUnits(units)}`];
    $("lengths").replaceChildren(heading(heads), el("tbody", {}, ...rows));
    $("lengths-words").textContent = map
      ? `At every pose the squared lengths of the equivalent are s′ = A s + c. The last column is computed from the original's lengths; it differs from the geometry by ${show(map.error, 2)} of the largest squared length.`
      : "Leg lengths at the pose shown.";
    $("map-details").hidden = !map;
    if (map) Tables.map(map);
  },

  map(map) {
    const rows = map.A.map((line, i) => row([legName(i + 1), ...line.map((x) => show(x, 5)), show(map.c[i], 6)]));
    $("map").replaceChildren(heading(["", ...map.A.map((_, j) => `s${j + 1}`), "c"]), el("tbody", {}, ...rows));
  },

  /** The requirements over the workspace, for the design shown, and at the pose shown. */
  margins(app, state) {
    const [first, second] = state.platforms;
    const { limits } = app;
    const go = (pose) => app.stopAt(pose);
    const whole = limits && !limits.error ? limits : null;
    const find = (list, name) => list?.find((m) => m.name === name);
    const names = [...new Set([...(whole ? whole.requirements : []), ...first.margins, ...(second ? second.margins : [])].map((m) => m.name))];
    $("margins-words").textContent = Limits.words({ app, state });
    // the table is made anew only when something in it has changed, so that its buttons keep the focus
    const key = JSON.stringify([whole, first.margins, second?.margins, first.inverse_condition, second?.inverse_condition]);
    if (key === Tables.margin) return;
    Tables.margin = key;
    // what rounding does not tell from zero is not written as a number
    const words = (m) => (m.at_limit ? "0, at the limit" : `${show(m.margin, 4)}${m.met ? "" : " violated"}`);
    const here = (m) => (m ? [el("span", { class: m.met ? null : "bad" }, words(m)), el("small", {}, m.between.join(", "))] : "–");
    const units = (r) => (r.unit === "force" ? " [force units]" : inUnits(r.unit));
    const own = first.margins.length > 0 || !second;
    const rows = names.map((name) => {
      const [w, a, b] = [find(whole?.requirements, name), find(first.margins, name), find(second?.margins, name)];
      const cells = [`${REQUIREMENTS[name] || name.replaceAll("_", " ")}${units(w || a || b)}`];
      if (whole) cells.push(Limits.cell(w, go));
      if (own) cells.push(here(a));
      if (second) cells.push(here(b));
      return row(cells);
    });
    const blank = [...(own ? ["–"] : []), ...(second ? ["–"] : [])];
    if (whole) {
      rows.push(row(["singular poses", Limits.regular(whole, go), ...blank]));
      rows.push(row(["conditioning σ₆/σ₁", Limits.conditioning(whole.conditioning, go), ...(own ? [show(first.inverse_condition, 3)] : []), ...(second ? [show(second.inverse_condition, 3)] : [])]));
    }
    const heads = ["requirement", ...(whole ? [second ? "workspace, equivalent" : "workspace"] : []), ...(own ? [second ? "here, original" : "here"] : []), ...(second ? ["here, equivalent"] : [])];
    $("margins").replaceChildren(...(names.length ? [heading(heads), el("tbody", {}, ...rows)] : []));
  },

  /** One row a mode: which is shown, which is the ghost. */
  modes(open, found, shown, compared, choose) {
    const radio = (name, k, on, words) =>
      el("input", { type: "radio", name, checked: on, "aria-label": `${words} mode ${k + 1}`, change: () => choose(name, k) });
    const turns = open.kind === "cranks";
    const rows = found.modes.map((mode, k) => {
      // what rounding leaves of a zero is one
      const p = mode.pose.p.map((x) => show(Math.abs(x) < 1e-9 * open.size ? 0 : x, 3)).join(", ");
      const cells = [[radio("mode", k, k === shown, "show"), `${k + 1}`], [radio("ghost", k, k === compared, "compare with")],
        { 1: "+", 0: "0", "-1": "−" }[mode.sign], ...(turns ? [mode.elbows_kept ? "yes" : "no"] : []), show(mode.inverse_condition, 3), `${fixed(mode.turn_deg, 0)}°`, `(${p})`];
      return row(cells, { class: k === shown ? "on" : null });
    });
    const none = radio("ghost", -1, compared < 0, "compare with no");
    none.setAttribute("aria-label", "compare with none");
    const last = row(["none", [none], "", "", "", "", ...(turns ? [""] : [])]);
    $("modes").replaceChildren(heading(["show", "ghost", "det\u00a0J", ...(turns ? ["elbows kept"] : []), "σ₆/σ₁", "turned", `position p${inUnits(open.units)}`]), el("tbody", {}, ...rows, last));
  },

  /** The live numbers. */
  tiles(list) {
    $("tiles").replaceChildren(...list.map(({ name, value, unit, tone, id, exact, wide }) =>
      el("div", { class: wide ? "key" : null }, el("dt", {}, name),
        el("dd", { id, class: tone || null, "data-value": exact === undefined ? null : String(exact) }, value, unit ? el("small", {}, unit) : null))));
  },
};
