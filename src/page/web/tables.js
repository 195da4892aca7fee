// Numbers in tables: the text alternative of every picture.

const Tables = {
  /** Leg lengths of both platforms, with what the leg map makes of the first ones. */
  lengths(state, units) {
    const [first, second] = state.platforms;
    const map = state.map;
    const joints = (p, k) => `${p.base[p.legs[k][0]].name} – ${p.platform[p.legs[k][1]].name}`;
    const rows = first.lengths.map((length, k) => {
      const cells = [legName(k + 1), joints(first, k), show(length, 8)];
      if (map) cells.push(joints(second, k), show(second.lengths[k], 8), show(Math.sqrt(map.image[k]), 8));
      return row(cells);
    });
    const heads = map
      ? ["", "original", `length [${units}]`, "equivalent", `length [${units}]`, "√(A s + c)"]
      : ["", "joints", `length [${units}]`];
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

  margins(state) {
    const [first, second] = state.platforms;
    const find = (p, r) => p && p.margins.find((m) => m.requirement === r.requirement);
    const own = first.margins.length > 0 || !second;
    const all = [...first.margins, ...(second ? second.margins.filter((m) => !find(first, m)) : [])];
    $("margins-card").hidden = false;
    $("margins-words").textContent = all.length
      ? "Least margin of each kind at the pose shown; below zero the requirement is violated."
      : "The design requires nothing: it has no [hardware], loads or keep-outs.";
    const cell = (m) => (m ? [el("span", { class: m.met ? "good" : "bad" }, `${show(m.margin, 4)}${m.met ? "" : " violated"}`)] : "–");
    const rows = all.map((r) => {
      const [a, b] = [find(first, r), find(second, r)];
      const cells = [`${r.requirement.replaceAll("_", " ")} [${r.unit}]`, cell(a), a ? a.between.join(", ") : "–"];
      const other = [cell(b), b ? b.between.join(", ") : "–"];
      return row(!second ? cells : own ? [...cells, ...other] : [cells[0], ...other]);
    });
    const heads = second && own ? ["requirement", "original", "of", "equivalent", "of"] : ["requirement", second ? "equivalent" : "margin", "of"];
    $("margins").replaceChildren(...(all.length ? [heading(heads), el("tbody", {}, ...rows)] : []));
  },

  /** One row a mode: which is shown, which is the ghost. */
  modes(found, shown, compared, choose) {
    const radio = (name, k, on, words) =>
      el("input", { type: "radio", name, checked: on, "aria-label": `${words} mode ${k + 1}`, change: () => choose(name, k) });
    const rows = found.modes.map((mode, k) => {
      const p = mode.pose.p.map((x) => show(x, 3)).join(", ");
      const cells = [[radio("mode", k, k === shown, "show"), `${k + 1}`], [radio("ghost", k, k === compared, "compare with")],
        { 1: "+", 0: "0", "-1": "−" }[mode.sign], show(mode.inverse_condition, 3), `(${p})`];
      return row(cells, { class: k === shown ? "on" : null });
    });
    const none = radio("ghost", -1, compared < 0, "compare with no");
    none.setAttribute("aria-label", "compare with none");
    const last = row(["", [none, " none"], "", "", ""]);
    $("modes").replaceChildren(heading(["show", "ghost", "det J", "σ₆/σ₁", "position p"]), el("tbody", {}, ...rows, ...(rows.length ? [last] : [])));
  },

  /** The live numbers. */
  tiles(list) {
    $("tiles").replaceChildren(...list.map(({ name, value, unit, tone, id, exact, wide }) =>
      el("div", { class: wide ? "key" : null }, el("dt", {}, name),
        el("dd", { id, class: tone || null, "data-value": exact === undefined ? null : String(exact) }, value, unit ? el("small", {}, unit) : null))));
  },
};
