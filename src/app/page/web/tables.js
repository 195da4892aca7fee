// Numbers in tables: the text alternative of every picture.

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

  /** The requirements over the workspace and at the pose shown; a margin with a pose gets a button that shows it. */
  margins(app, state) {
    $("margins-words").textContent = Limits.words({ app, state });
    // the table is made anew only when something in it has changed, so that its buttons keep the focus
    if (state.requirements === Tables.shown) return;
    Tables.shown = state.requirements;
    // the core has escaped every text in it
    $("margins").innerHTML = state.requirements;
    for (const cell of $("margins").querySelectorAll("[data-pose]")) {
      const go = () => app.stopAt(JSON.parse(cell.dataset.pose));
      cell.append(" ", el("button", { type: "button", class: "plain", click: go }, "show pose"));
    }
  },

  /** One row a mode: which is shown, which is the ghost. */
  modes(open, found, shown, compared, choose) {
    const radio = (name, k, on, words) =>
      el("input", { type: "radio", name, checked: on, "aria-label": `${words} mode ${k + 1}`, change: () => choose(name, k) });
    const turns = open.kind === "cranks";
    const rows = found.modes.map((mode, k) => {
      // what rounding leaves of a zero is one
      const p = mode.written.slice(0, 3).map((x) => show(Math.abs(x) < 1e-9 * open.size ? 0 : x, 3)).join(", ");
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
