// The actions of the page: paths, modes, self-motions, files.

/** Milliseconds without a movement after which the modes are searched for. */
const RESTED = 300;

Object.assign(App.prototype, {
  /** The player stands at a share of the way. */
  move(at) {
    if (this.path === "motion" && this.motion) {
      const n = this.motion.poses.length;
      const share = this.motion.closed ? at : 1 - Math.abs(2 * at - 1);
      this.pose = this.motion.poses[Math.min(n - 1, Math.floor(share * n))];
    } else {
      this.pose = this.core.ask({ op: "path", at }).pose;
    }
    this.moved();
  },

  /** The platform stands at another pose. */
  moved() {
    this.shown = -1;
    this.legFields.typed = false;
    this.stale();
    this.soon();
  },

  /** The pose of six numbers in the convention of the design; `null` where the core refuses it. */
  place(values) {
    const { pose, error } = this.core.ask({ op: "place", numbers: values });
    if (error) return null;
    this.stand(pose);
    return pose;
  },

  /** Another pose, asked for by itself and not by the player. */
  stand(pose) {
    this.player.rest(this.player.at);
    this.leaveMotion();
    this.pose = pose;
    this.moved();
  },

  /** The worst pose of a requirement. */
  stopAt({ p, q }) {
    const { pose } = this.core.ask({ op: "quaternion", p, q });
    if (!pose) return;
    this.stand(pose);
    $("stage").scrollIntoView({ block: "nearest" });
  },

  /** The modes listed belong to other leg lengths once the platform has moved. */
  stale() {
    if (this.compared >= 0 || this.listed !== "stale") {
      this.compared = -1;
      this.listed = "stale";
      this.listModes();
    }
    this.rested();
  },

  /** When the platform has come to rest, its modes are searched for. */
  rested() {
    if (this.listed === "stale" && !this.player.running && this.core.live) this.findModes(RESTED);
  },

  /** The lengths of the pose shown in the fields, whatever was typed there. */
  showLengths() {
    this.legFields.typed = false;
    this.soon();
  },

  goHome() {
    this.player.rest(0);
    this.pose = this.open.home;
    this.leaveMotion();
    this.moved();
  },

  choosePath(path) {
    this.path = path;
    this.player.rest(0);
    if (path === "motion") this.followMotion();
    else {
      this.tasks.motion.drop();
      $("motion-words").textContent = "";
    }
  },

  /** The curve of poses with the present leg lengths. */
  followMotion() {
    const which = this.pattern ? "second" : "first";
    this.tasks.motion.ask(this.core, { op: "motion", pose: this.pose, which, chosen: this.chosen }, (found) => this.showMotion(found));
  },

  showMotion(found) {
    const whose = this.pattern ? "the equivalent platform" : "the platform";
    if (found.error || !found.poses.length) {
      const why = found.error ? found.error.message
        : found.dimension > 1 ? `it moves with ${found.dimension} freedoms at this pose` : `the legs of ${whose} hold it at this pose; choose offsets with det A = 0`;
      $("motion-words").textContent = found.dimension === null
        ? "Undecided: tracing found no self-motion, and the second order excludes none."
        : `No self-motion: ${why}.`;
      this.path = "workspace";
      $("path").value = "workspace";
      return;
    }
    this.motion = found;
    $("motion-words").textContent = `Self-motion: ${found.poses.length} poses of ${whose} with the same six leg lengths (to ${show(found.length_error, 2)} of the size), `
      + (found.closed ? "a closed curve." : `a curve, traced until it is ${found.end}.`)
      + (this.pattern ? " The legs of the original change." : "");
    this.move(0);
  },

  /** Answers about other offsets are not waited for. */
  left() {
    if (this.tasks.confirm.drop()) this.listModes();
    this.leaveMotion();
  },

  leaveMotion() {
    this.tasks.motion.drop();
    if (this.path !== "motion") return;
    this.player.rest(0);
    this.path = "workspace";
    this.motion = null;
    $("path").value = "workspace";
    $("motion-words").textContent = "";
  },

  /** The steps to the leg map with the offsets shown, if they are open. */
  derive() {
    if (!this.pattern || !$("derivation-details").open) return;
    const key = JSON.stringify(this.chosen);
    if (this.derived === key) return;
    this.derived = key;
    $("derivation").replaceChildren();
    this.tasks.derivation.ask(this.core, { op: "derivation", chosen: this.chosen }, (found) => {
      $("derivation-words").textContent = found.error ? found.error.message : "";
      // the core has escaped every text in it
      $("derivation").innerHTML = found.html || "";
    });
  },

  /** What takes longer, when the sliders rest; said when somebody has changed an offset. */
  slow(said = false) {
    this.tasks.worst.ask(this.core, { op: "worst", chosen: this.chosen }, (worst) => {
      this.worst = worst;
      this.soon();
      if (said) this.speak();
    });
    this.assess();
    this.derive();
    if (this.pattern && this.pattern.offsets.length > 1) {
      const { low, high, points } = PLANE;
      const plane = this.core.ask({ op: "plane", chosen: this.chosen, axes: this.plane.axes, range: [low, high], points });
      this.planeAnswer = plane;
      this.shade();
      if (this.core.live && this.pattern.offsets.length > 2 && $("space-details").open) {
        const axes = [...this.plane.axes, this.space.axis];
        this.surface = this.core.ask({ op: "surface", chosen: this.chosen, axes, range: [low, high], points: SURFACE.points });
      }
    }
    this.soon();
  },

  /** Where over the plane of offsets a requirement is violated in the workspace: a quick check, then a finer one. It stays the same while the mark alone moves. */
  shade() {
    const { axes } = this.plane;
    const others = this.offsets.map((t, k) => (axes.includes(k) ? null : t));
    const key = JSON.stringify([this.pattern.id, axes, others]);
    if (!this.core.live || this.shaded === key) return;
    this.shaded = key;
    this.feasible = null;
    const { low, high } = PLANE;
    const request = { op: "feasible", chosen: this.chosen, axes, range: [low, high] };
    const { core } = this;
    this.tasks.feasible.ask(core, { ...request, ...SHADE.rough }, (rough) => {
      this.feasible = rough;
      this.soon();
      if (rough.error || !Task.possible) return;
      this.tasks.feasible.ask(core, { ...request, ...SHADE.fine }, (fine) => {
        this.feasible = fine;
        this.soon();
      });
    });
  },

  /** The singular positions with the orientation shown, if they are open. */
  findLocus() {
    this.located = null;
    this.locus = null;
    this.tasks.locus.drop();
    $("locus-words").textContent = "";
    this.soon();
  },

  /** What there is of them to draw; asked for anew when the orientation is another one. */
  singularPositions(state) {
    if (!$("locus").checked || !this.core.live) return null;
    const key = JSON.stringify(state.pose.R);
    if (this.located !== key) {
      this.located = key;
      this.locus = null;
      this.tasks.locus.ask(this.core, { op: "locus", pose: this.pose, which: "first", points: SURFACE.points }, (found) => {
        this.locus = found;
        $("locus-words").textContent = this.locusInWords(found);
        this.soon();
      }, RESTED);
    }
    const { locus } = this;
    return locus && !locus.error && !locus.everywhere ? { ...locus, at: state.pose.p } : null;
  },

  locusInWords(found) {
    if (found.error) return found.error.message;
    if (found.everywhere) return "Every position is singular: the platform is architecturally singular.";
    const both = this.pattern ? " It is the same one for each regular equivalent." : "";
    return found.surface.triangles.length
      ? `With this orientation the platform is singular where its origin (the cross) is on the red surface.${both} The dotted box has the positions of the workspace.`
      : "With this orientation no position about home is singular.";
  },

  /** The requirements over the workspace: a quick check, then what `equipod assess` does. */
  assess() {
    this.limits = null;
    if (!this.core.live) return;
    const request = { op: "assess", which: this.pattern ? "second" : "first", chosen: this.chosen };
    const { core } = this;
    this.tasks.limits.ask(core, { ...request, ...ROUGH }, (rough) => {
      this.limits = { ...rough, whole: false };
      this.soon();
      // where the page itself would have to compute, it would not respond for too long
      if (rough.error || !Task.possible) return;
      this.tasks.limits.ask(core, { ...request, ...THOROUGH }, (found) => {
        this.limits = { ...found, whole: true };
        this.soon();
      });
    });
  },

  /** The numbers after a change, for those who do not see them. */
  speak() {
    if (!this.state || !this.pattern) return;
    const state = this.core.ask({ op: "state", pose: this.pose, chosen: this.chosen });
    if (!state.error) $("live").textContent = `det A ${show(state.map.det, 4)}, worst conditioning of the equivalent ${show(this.worst.second ? this.worst.second.inverse_condition : null, 3)}`;
  },

  findModes(after = 0) {
    const { pose } = this;
    this.tasks.modes.ask(this.core, { op: "modes", pose, which: "first" }, (found) => {
      this.modes = found;
      this.modesOf = "first";
      this.compared = -1;
      this.shown = -1;
      this.listed = this.pose === pose ? "here" : "stale";
      this.listModes();
      this.soon();
    }, after);
  },

  /** All poses for lengths that somebody typed; the real one nearest to the pose shown is shown. */
  findFor(lengths) {
    if (!lengths) {
      $("lengths-state").textContent = this.cranks ? "Give six numbers." : "Give six positive numbers.";
      return;
    }
    this.player.rest(0);
    this.leaveMotion();
    const { pose } = this;
    const which = this.pattern ? this.whose : "first";
    this.tasks.modes.ask(this.core, { op: "modes", pose, lengths, which, chosen: this.chosen }, (found) => {
      this.modes = found;
      this.modesOf = which;
      this.compared = -1;
      this.shown = -1;
      this.listed = "stale";
      // who has moved the platform meanwhile is not taken from there
      if (!found.error && found.modes.length && this.pose === pose) {
        this.shown = found.nearest;
        this.listed = "here";
        this.pose = found.modes[found.nearest].pose;
        this.legFields.typed = false;
      } else if (!found.error && !found.modes.length) {
        this.listed = "typed";
        $("lengths-state").textContent = `No real pose with these ${this.cranks ? "angles" : "lengths"} was found.`;
      }
      this.listModes();
      this.soon();
    });
  },

  listModes() {
    const { modes } = this;
    if (!modes || modes.error || !modes.modes.length) $("modes").replaceChildren();
    else Tables.modes(this.open, modes, this.here(), this.compared, (name, k) => this.chooseMode(name, k));
    // while others are searched for, that is said
    this.captionGhost();
    if (!this.tasks.modes.job) $("modes-words").textContent = this.modesInWords();
  },

  /** Which mode of the list is shown; -1 for none. */
  here() {
    if (this.listed !== "here") return -1;
    return this.shown >= 0 ? this.shown : (this.modes.here ?? -1);
  },

  modesInWords() {
    const { modes } = this;
    if (!modes) return "";
    if (modes.error) return modes.error.message;
    const of = !this.pattern ? "the platform" : this.modesOf === "second" ? "the equivalent" : "the original";
    const count = modes.solution_set === "positive_dimensional"
      ? `At exactly these lengths ${of} has a curve of complex poses; ${modes.modes.length ? `${modes.modes.length} real poses on it are listed` : "no real pose was found on it"}. Isolated poses beside the curve are not listed (the pose shown may be one): move the platform a little and solve again.`
      : `${modes.modes.length} real poses of ${modes.finite} finite complex poses of ${of} (method ${modes.method}). The list is ${modes.proved ? "proved complete" : "not proved complete"}; ${modes.modes.filter((m) => m.certified).length} real poses are certified.`;
    return this.listed === "stale" ? `${count} The platform has moved since: the poses belong to the earlier ${this.cranks ? "angles" : "lengths"}.` : count;
  },

  captionGhost() {
    $("ghost-words").textContent = this.compared < 0 ? "" : ` Dashed: mode ${this.compared + 1}.`;
  },

  chooseMode(name, k) {
    if (name === "ghost") {
      this.compared = k;
      this.captionGhost();
    } else {
      this.player.rest(0);
      this.leaveMotion();
      this.tasks.modes.drop();
      this.shown = k;
      this.listed = "here";
      this.pose = this.modes.modes[k].pose;
      this.legFields.typed = false;
      this.listModes();
      document.querySelectorAll("#modes input[name=mode]")[k].focus();
    }
    this.soon();
  },

  /** The other platform's own forward kinematics, for the same pose. */
  confirm() {
    this.tasks.confirm.ask(this.core, { op: "confirm", pose: this.pose, chosen: this.chosen }, (found) => this.showConfirmed(found));
  },

  showConfirmed(found) {
    $("modes-words").textContent = found.error ? found.error.message
      : `Each platform was solved from its own leg lengths: the original has ${found.first.finite} finite poses (${found.first.method}), the equivalent has ${found.second.finite} (${found.second.method}); `
        + (found.distance === null ? "they cannot be paired." : `paired, they are at most ${show(found.distance, 2)} of the size apart.`);
  },

  downloads() {
    const links = [["first", this.pattern ? "original" : "design"], ...(this.pattern ? [["second", "equivalent"]] : [])];
    const buttons = links.flatMap(([which, words]) => ["toml", "json"].map((format) =>
      el("button", { type: "button", click: () => this.download(which, format) }, `${words}, ${format.toUpperCase()}`)));
    $("downloads").replaceChildren(...buttons);
  },

  download(which, format) {
    const design = this.core.ask({ op: "design", which, chosen: this.chosen });
    if (design.error) {
      $("files-words").textContent = design.error.message;
      return;
    }
    const name = `${design.name.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "")}.${format}`;
    const link = el("a", { href: URL.createObjectURL(new Blob([design[format]], { type: "text/plain" })), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
    $("files-words").textContent = `${name} is in your downloads.`;
  },

  async replace(file) {
    try {
      this.reopen({ design: await file.text(), trajectory: [], start: null });
    } catch (error) {
      Begin.say(`${file.name}: ${error.message}`, [], true);
      return;
    }
    Begin.say(`${file.name} is open.`, [], false);
  },

  /** Another design in the place of this one; throws the reason when the core refuses it. */
  reopen(opening) {
    this.core = this.core.replace(opening);
    this.player.rest(0);
    Object.values(this.tasks).forEach((task) => task.drop());
    this.begin();
    this.views.forEach((v) => { v.scene = this.scene; });
    this.rebuild();
  },

  /** The design, the equivalent chosen and the pose in a link. */
  async share() {
    const hash = await Share.pack({ ...this.core.opening, start: this.chosen, at: { numbers: this.state.written } });
    $("link").value = location.href.split("#")[0] + hash;
    $("link").hidden = false;
    $("link").select();
    $("files-words").textContent = `The link has ${$("link").value.length} characters and holds the design, the offsets and the pose; it opens wherever this page is.`;
  },

  /** Opens what the link of the page holds. */
  async follow() {
    try {
      const held = await Share.unpack(location.hash);
      if (!held) return;
      const { at, ...opening } = held;
      this.reopen(opening);
      // links of 0.1.0 have position and roll, pitch, yaw
      if (at) this.place(at.numbers || [...at.position, ...at.rpy_deg]);
    } catch (error) {
      $("note").hidden = false;
      $("note").textContent = `The link holds no design that can be opened: ${error.message}.`;
    }
  },
});

openCore().then(async (core) => {
  if (!core.live) {
    $("note").hidden = false;
    $("note").textContent = `This page shows recorded data: ${core.why}. It has one round of poses, the assembly modes at home and det A over two offsets; sliders need the core in WebAssembly.`;
  }
  $("about").textContent = `equipod ${data.version}. ${core.live ? "Every number is computed here by its core, compiled to WebAssembly; nothing is sent anywhere." : "Recorded data."}`;
  const app = new App(core);
  Begin.build(app);
  if (core.live) await app.follow();
  document.documentElement.dataset.ready = core.live ? "live" : "recorded";
});
