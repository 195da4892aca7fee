// The page: what is shown, and who is told when it changes.

class App {
  constructor(core) {
    this.core = core;
    this.camera = new Camera(() => this.soon());
    this.begin();
    this.player = new Player((at) => this.move(at), () => this.rested());
    this.poseFields = new PoseFields($("pose-sliders"), (values) => this.place(values));
    this.legFields = new LegFields($("leg-fields"), $("lengths-state"));
    this.sliders = new Sliders($("sliders"), (changes) => this.change(changes));
    this.hexagon = new Hexagon($("hexagon"), (k, t) => this.change([[k, t]]));
    this.plane = new Plane($("plane"), $("plane-words"), (changes) => this.change(changes));
    this.space = new Space($("space"), $("space-words"));
    this.views = ["first", "second"].map((name) => new View($(`view-${name}`), this.camera, this.scene));
    this.settle = later(160, () => this.slow(true));
    const say = (id, words) => () => { $(id).textContent = words; };
    this.tasks = {
      modes: new Task(say("modes-words", "Searching for all poses with these leg lengths …")),
      confirm: new Task(say("modes-words", "Solving for both platforms …")),
      motion: new Task(say("motion-words", "Searching for a self-motion through this pose …")),
      worst: new Task(() => { this.worst = null; this.soon(); }),
      limits: new Task(() => this.soon(), "assessing"),
      feasible: new Task(() => this.soon(), "assessing"),
      locus: new Task(say("locus-words", "Searching for the singular positions …")),
      derivation: new Task(say("derivation-words", "Solving for both platforms …")),
    };
    this.listen();
    this.rebuild();
  }

  /** Everything from a new design. */
  begin() {
    const open = this.core.ask({ op: "open" });
    this.open = open;
    this.scene = { centre: open.centre, radius: open.radius };
    this.pose = open.home;
    this.path = "workspace";
    this.motion = null;
    this.compared = -1;
    this.shown = -1;
    this.listed = "here";
    this.modes = null;
    this.worst = null;
    this.limits = null;
    this.feasible = null;
    this.shaded = null;
    this.surface = null;
    this.locus = null;
    this.located = null;
    this.derived = null;
    this.whose = "first";
    this.pattern = open.patterns ? open.patterns.find((p) => p.id === open.start.pattern) : null;
    this.offsets = open.start ? [...open.start.offsets] : [];
    this.remembered = { [open.start ? open.start.pattern : ""]: this.offsets };
  }

  /** Whether the legs are rods on cranks. */
  get cranks() {
    return this.open.kind === "cranks";
  }

  get chosen() {
    return this.pattern ? { pattern: this.pattern.id, offsets: this.offsets } : null;
  }

  listen() {
    $("home").addEventListener("click", () => this.goHome());
    $("names").addEventListener("change", () => this.soon());
    $("path").addEventListener("change", () => this.choosePath($("path").value));
    $("pattern").addEventListener("change", () => this.choosePattern($("pattern").value));
    $("restart").addEventListener("click", () => this.change(this.first().map((t, k) => [k, t])));
    for (const [id, axis] of [["axis-x", 0], ["axis-y", 1]]) {
      $(id).addEventListener("change", () => this.chooseAxis(axis, Number($(id).value)));
    }
    $("axis-z").addEventListener("change", () => {
      this.space.axis = Number($("axis-z").value);
      this.slow();
    });
    $("space-details").addEventListener("toggle", () => this.slow());
    $("derivation-details").addEventListener("toggle", () => this.derive());
    $("locus").addEventListener("change", () => this.findLocus());
    $("find").addEventListener("click", () => this.findModes());
    $("by-lengths").addEventListener("submit", (e) => {
      e.preventDefault();
      this.findFor(this.legFields.read());
    });
    $("as-shown").addEventListener("click", () => this.showLengths());
    $("of-file").addEventListener("click", () => this.legFields.take(this.open.lengths));
    $("whose").addEventListener("change", () => {
      this.whose = $("whose").value;
      this.showLengths();
    });
    $("share").addEventListener("click", () => this.share());
    window.addEventListener("hashchange", () => this.follow());
    $("confirm").addEventListener("click", () => this.confirm());
    $("open").addEventListener("change", (e) => e.target.files[0] && this.replace(e.target.files[0]));
    // what is printed has the light colours
    matchMedia("print").addEventListener("change", () => this.show());
    window.addEventListener("resize", () => this.soon());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.soon());
  }

  /** Builds what depends on the design and the pattern. */
  rebuild() {
    const { open, pattern } = this;
    const enabled = this.core.live;
    $("name").textContent = open.name;
    document.title = `${open.name} · equipod`;
    const kinds = {
      octahedral: "Octahedral platform and its kinematic equivalents: the same poses, squared leg lengths related by s′ = A s + c",
      equivalent: "Platform without shared joints and its octahedral original",
      general: "Stewart platform",
      cranks: "Rods of constant length on six cranks",
    };
    $("kind").textContent = kinds[open.kind];
    $("caption-first").replaceChildren(el("b", {}, pattern ? "Original" : "Platform"), ` ${pattern ? "octahedral" : open.name} `, el("span", { class: "chip", id: "regular-first" }));
    const { cranks } = this;
    $("regular-first").title = open.reason || (cranks ? "" : "some pose holds the platform: proved in exact arithmetic");
    $("pose-title").textContent = cranks ? "Pose and crank angles" : "Pose and leg lengths";
    $("pose-help").textContent = `Move a slider or type a number, and the ${cranks ? "crank angles" : "leg lengths"} follow. Type ${cranks ? "angles" : "leg lengths"} (or paste all six into one field) to find their poses. ${open.frames.sentence}`;
    Begin.symmetry(this);
    $("lengths-what").textContent = cranks ? "Crank angles" : "Leg lengths";
    $("lengths-title").textContent = cranks ? "Cranks" : "Leg lengths";
    $("locus-label").hidden = cranks;
    $("figure-second").hidden = !pattern;
    document.querySelector(".views").classList.toggle("one", !pattern);
    document.querySelector("main").classList.toggle("plain", !pattern);
    for (const id of ["offsets", "hexagon-card", "plane-card", "derivation-card"]) $(id).hidden = !pattern;
    $("confirm").hidden = !pattern;
    const [skip] = document.getElementsByClassName("skip");
    skip.href = pattern ? "#offsets" : "#modes-card";
    skip.textContent = `Skip to the ${pattern ? "offsets" : "assembly modes"}`;
    this.poseFields.build(open, this.home(), enabled);
    this.legFields.build(open, enabled);
    $("lengths-units").textContent = cranks ? " [°]" : inUnits(open.units);
    $("whose-label").hidden = !pattern;
    $("whose").value = this.whose;
    $("of-file").hidden = !open.lengths;
    for (const id of ["find", "confirm", "solve", "as-shown", "of-file", "whose", "share", "pattern", "restart", "linked", "axis-x", "axis-y", "axis-z", "locus"]) $(id).disabled = !enabled;
    const paths = [["workspace", open.trajectory ? "trajectory of the design" : "through the workspace"], ...(cranks ? [] : [["motion", "self-motion"]])];
    $("path").replaceChildren(...paths.map(([value, words]) => el("option", { value, selected: value === this.path }, words)));
    if (pattern) this.rebuildPattern();
    $("locus").checked = false;
    this.findLocus();
    this.downloads();
    this.lookAround();
    this.listModes();
    this.findModes();
    this.slow();
    this.soon();
  }

  /** The six numbers of home. */
  home() {
    const state = this.core.ask({ op: "state", pose: this.open.home, chosen: this.chosen });
    return state.written || [...this.open.home.p, 0, 0, 0];
  }

  /** The first direction of view. */
  lookAround() {
    const state = this.core.ask({ op: "state", pose: this.open.home, chosen: this.chosen });
    if (!state.error) this.camera.look(state.platforms, this.open, this.open.hardware.leg || 0);
  }

  rebuildPattern() {
    const words = (p) => `${p.id}: ${p.base_joints}-${p.platform_joints}, ${p.shared_joints ? `${p.shared_joints} shared` : "none shared"}`;
    $("pattern").replaceChildren(...this.open.patterns.map((p) => el("option", { value: p.id, selected: p === this.pattern }, words(p))));
    $("caption-second").replaceChildren(el("b", {}, "Equivalent"), ` ${this.pattern.id}, ${this.pattern.base_joints}-${this.pattern.platform_joints}; dotted: triangles of the original `, el("span", { class: "chip", id: "regular-second" }));
    $("formula").textContent = `det A = ${this.pattern.det}`;
    this.sliders.build(this.open, this.pattern, this.core.live);
    this.hexagon.build(this.open.hexagon, this.pattern, this.core.live);
    this.plane.axes = [0, Math.min(1, this.pattern.offsets.length - 1)];
    this.plane.enabled = this.core.live;
    $("plane-card").hidden = this.pattern.offsets.length < 2;
    $("space-details").hidden = this.pattern.offsets.length < 3 || !this.core.live;
    this.axes();
  }

  axes() {
    // the third axis is one that the plane has not
    const rest = this.pattern.offsets.map((_, k) => k).filter((k) => !this.plane.axes.includes(k));
    if (!rest.includes(this.space.axis)) [this.space.axis] = rest;
    $("axis-z").replaceChildren(...rest.map((k) => el("option", { value: k, selected: k === this.space.axis }, `${this.pattern.offsets[k].name} (${this.pattern.offsets[k].joint})`)));
    [["axis-x", 0], ["axis-y", 1]].forEach(([id, axis]) => {
      const options = this.pattern.offsets.map((o, k) => el("option", { value: k, selected: k === this.plane.axes[axis] }, `${o.name} (${o.joint})`));
      $(id).replaceChildren(...options);
    });
  }

  chooseAxis(axis, k) {
    const other = this.plane.axes[1 - axis];
    if (k === other) this.plane.axes[1 - axis] = this.plane.axes[axis];
    this.plane.axes[axis] = k;
    this.axes();
    this.slow();
  }

  first() {
    const { start } = this.open;
    return start.pattern === this.pattern.id ? start.offsets : this.core.ask({ op: "start", pattern: this.pattern.id }).offsets;
  }

  choosePattern(id) {
    this.remembered[this.pattern.id] = this.offsets;
    this.pattern = this.open.patterns.find((p) => p.id === id);
    this.offsets = this.remembered[id] || this.first();
    this.left();
    this.rebuildPattern();
    this.slow(true);
    this.soon();
  }

  /** New values of some offsets. */
  change(changes) {
    if (!this.core.live) return;
    this.offsets = [...this.offsets];
    for (const [k, t] of changes) {
      if (!$("linked").checked) this.offsets[k] = t;
      else this.pattern.offsets.forEach((o, i) => {
        if (o.side % 2 === this.pattern.offsets[k].side % 2) this.offsets[i] = t;
      });
    }
    this.left();
    this.settle();
    this.soon();
  }

  soon() {
    if (this.waiting) return;
    this.waiting = requestAnimationFrame(() => {
      this.waiting = 0;
      this.show();
    });
  }

  /** Everything that changes with the pose or an offset. */
  show() {
    const limits = this.limits?.error ? null : this.limits;
    const state = this.core.ask({ op: "state", pose: this.pose, chosen: this.chosen, limits });
    if (state.error) {
      $("motion-words").textContent = state.error.message;
      return;
    }
    this.state = state;
    const [first, second] = state.platforms;
    const names = $("names").checked;
    const ghosts = this.ghosts();
    this.frame([...state.platforms, ...ghosts].filter(Boolean));
    const { hardware } = this.open;
    const locus = this.singularPositions(state);
    this.views[0].draw(first, { ghost: ghosts[0], names, hardware, locus });
    // those of a regular equivalent are the same
    const same = state.map && !Limits.singular(this, state);
    if (second) this.views[1].draw(second, { original: first, ghost: ghosts[1], names, hardware, locus: same ? locus : null });
    const what = (p) => (this.cranks ? `crank angles ${Cranks.angles(p)?.map((x) => show(x, 4)).join(", ") || "none"} degrees` : `leg lengths ${p.lengths.map((x) => show(x, 4)).join(", ")}${unit(this.open.units)}`);
    const place = (p) => `3D view of ${p.name}: ${what(p)}. Arrow keys turn it.`;
    this.views.forEach((v, k) => state.platforms[k] && v.canvas.setAttribute("aria-label", place(state.platforms[k])));
    if (this.pattern) {
      this.sliders.update(this.offsets, state.map.zeros);
      this.hexagon.update(this.offsets, state.map.zeros);
      const shown = { pattern: this.pattern, offsets: this.offsets, det: state.map.det };
      this.plane.draw(this.planeAnswer, this.feasible, shown);
      if ($("space-details").open) this.space.draw(this.surface, this.pattern, { ...shown, axes: [...this.plane.axes, this.space.axis] });
      const words = this.core.live ? Plane.words(this.feasible, this.plane.axes.map((k) => this.offsets[k])) : "";
      if ($("feasible-words").textContent !== words) $("feasible-words").textContent = words;
    }
    this.poseFields.update(this.pose, state);
    this.legFields.update(this.cranks ? Cranks.angles(first) : this.platformOfLengths().lengths);
    if (this.cranks) Cranks.table(first.cranks, this.open.units);
    else Tables.lengths(state, this.open.units);
    Tables.margins(this, state);
    this.tiles();
    this.badges();
    const p = state.pose.p.map((x) => fixed(x, 3)).join(", ");
    $("pose-words").textContent = `p = (${p})${unit(this.open.units)}, R = [${state.pose.R.map((r) => r.map((x) => fixed(x, 3)).join(" ")).join("; ")}]`;
    document.documentElement.dataset.shown = JSON.stringify(this.offsets);
  }

  /** The platform whose lengths are in the fields. */
  platformOfLengths() {
    return this.state.platforms[this.whose === "second" && this.pattern ? 1 : 0];
  }

  badges() {
    const about = { app: this, state: this.state };
    const put = (node, [tone, words]) => {
      node.className = `${node.id === "badge" ? "badge" : "chip"} ${tone}`;
      if (node.textContent !== words) node.textContent = words;
    };
    put($("badge"), Limits.verdict(about));
    this.state.platforms.forEach((_, k) => put($(k ? "regular-second" : "regular-first"), Limits.regularity({ ...about, k })));
  }

  /** What both pictures hold: the platform at home, and more when something is far from it. */
  frame(platforms) {
    const { centre, radius } = this.open;
    const points = platforms.flatMap((p) => [...p.base, ...p.platform]).map((j) => j.at);
    const far = (c) => Math.max(...points.map((p) => Math.hypot(...p.map((x, k) => x - c[k]))));
    this.scene.centre = centre;
    this.scene.radius = radius;
    if (far(centre) <= 1.3 * radius) return;
    const ends = [0, 1, 2].map((k) => points.map((p) => p[k]));
    this.scene.centre = ends.map((x) => (Math.min(...x) + Math.max(...x)) / 2);
    this.scene.radius = far(this.scene.centre);
  }

  ghosts() {
    const mode = this.compared >= 0 && this.modes?.modes ? this.modes.modes[this.compared] : null;
    if (!mode) return [null, null];
    const state = this.core.live ? this.core.ask({ op: "state", pose: mode.pose, chosen: this.chosen }) : null;
    return state && !state.error ? state.platforms : [null, null];
  }

  tiles() {
    const { state, open, worst } = this;
    const [first, second] = state.platforms;
    const list = [];
    const near = (s) => (s ? show(s.distance, 4) : "–");
    const sign = (s) => ({ 1: "+", 0: "0", "-1": "−" })[s];
    if (state.map) {
      const singular = Math.abs(state.map.det) < open.limits.det;
      list.push({ name: "det A of the leg map", id: "det", exact: state.map.det, wide: true, value: show(state.map.det), tone: singular ? "bad" : "good",
        unit: Limits.singular(this, state) ? "singular: this platform cannot be held at any pose" : singular ? `below ${show(open.limits.det)}: too close to a singular platform` : "regular: same poses as the original" });
    }
    const both = (a, b) => (second ? `${a} · ${b}` : a);
    const pair = second ? "original · equivalent" : "";
    list.push({ name: "conditioning σ₆/σ₁ here", id: "condition", value: both(show(first.inverse_condition, 3), second && show(second.inverse_condition, 3)), unit: second ? `${pair}; 1 is best` : "1 is best, 0 singular" });
    const value = (w) => (w ? show(w.inverse_condition, 3) : "…");
    list.push({ name: worst ? `worst σ₆/σ₁ of ${worst.poses} poses` : "worst σ₆/σ₁", id: "worst", value: both(value(worst?.first), value(worst?.second)), unit: pair });
    const closest = (body) => (second ? `${pair}: ${second.spacing[body]?.joints.join(", ")}` : first.spacing[body]?.joints.join(", "));
    list.push({ name: `closest base joints${inUnits(open.units)}`, id: "spacing-base", value: both(near(first.spacing.base), second && near(second.spacing.base)), unit: closest("base") });
    list.push({ name: `closest platform joints${inUnits(open.units)}`, id: "spacing-platform", value: both(near(first.spacing.platform), second && near(second.spacing.platform)), unit: closest("platform") });
    if (this.cranks) list.push(...Cranks.tiles(first.cranks));
    list.push({ name: "sign of det J here", id: "sign", value: both(sign(first.sign), second && sign(second.sign)), unit: pair });
    Tables.tiles(list);
  }
}
