// One's own hexapod: from the numbers of a data sheet, from twelve points, from an example or a file.

const SHEET = ["base_radius", "platform_radius", "base_spread_deg", "platform_spread_deg", "height"];

const Begin = {
  /** Fills the choices and listens. */
  build(app) {
    if (data.begin) $("begin").open = true;
    for (const node of $("begin").querySelectorAll("input, select, textarea, button")) node.disabled = !app.core.live;
    if (!app.core.live) return;
    const choices = app.core.ask({ op: "presets" });
    $("preset").replaceChildren(el("option", { value: "" }, "choose one"), ...choices.map((p) => el("option", { value: p.name }, `${p.name} (${p.class})`)));
    $("sheet").addEventListener("submit", (e) => {
      e.preventDefault();
      const numbers = Object.fromEntries(SHEET.map((id) => [id, $(id).value.trim() === "" ? NaN : Number($(id).value)]));
      if (!Object.values(numbers).every(Number.isFinite)) Begin.say("Give five numbers.", [], true);
      else Begin.take(app, { op: "sheet", ...numbers, units: $("sheet-units").value }, "The hexapod is shown below.");
    });
    $("points-form").addEventListener("submit", (e) => {
      e.preventDefault();
      Begin.take(app, { op: "points", text: $("points").value, units: $("points-units").value }, "The hexapod with these joints is shown below.");
    });
    $("preset").addEventListener("change", () => {
      if ($("preset").value) Begin.take(app, { op: "preset", name: $("preset").value }, `${$("preset").value} is shown below.`);
    });
  },

  /** Says which symmetry the joints have but for rounding, with a button that makes it exact. */
  symmetry(app) {
    const found = app.core.live ? app.open.symmetry : null;
    $("symmetry").hidden = !found;
    $("symmetry-found").replaceChildren(...(found || []).map((sentence) => el("li", {}, sentence)));
    $("snap").onclick = () => {
      Begin.take(app, { op: "snap" }, "The joints are written as exact constructions; the design below has them.");
      $("begin").open = true;
      $("begin-words").scrollIntoView({ block: "nearest" });
    };
  },

  take(app, request, words) {
    const made = app.core.ask(request);
    if (made.error) {
      Begin.say(made.error.message, [], true);
      return;
    }
    try {
      app.reopen({ design: made.toml, trajectory: request.op === "snap" ? app.core.opening.trajectory : [], start: null });
    } catch (error) {
      Begin.say(error.message, [], true);
      return;
    }
    Begin.say(words, made.guesses, false);
  },

  say(words, guesses, bad) {
    $("begin-words").textContent = words;
    $("begin-words").classList.toggle("bad", bad);
    $("guesses").replaceChildren(...guesses.map((guess) => el("li", {}, guess)));
  },
};
