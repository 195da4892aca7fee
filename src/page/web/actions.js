// What the page does when asked: paths, modes, self-motions, files.

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
    this.shown = -1;
    this.stale();
    this.soon();
  },

  /** The modes listed belong to other leg lengths once the platform has moved. */
  stale() {
    if (this.compared >= 0 || this.listed !== "stale") {
      this.compared = -1;
      this.listed = "stale";
      this.listModes();
    }
  },

  goHome() {
    this.player.rest(0);
    this.pose = this.open.home;
    this.leaveMotion();
    this.shown = -1;
    this.stale();
    this.soon();
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
        : found.dimension > 1 ? `it moves with ${found.dimension} freedoms here` : `the legs of ${whose} hold it at this pose; choose offsets with det A = 0`;
      $("motion-words").textContent = `No self-motion: ${why}.`;
      this.path = "workspace";
      $("path").value = "workspace";
      return;
    }
    this.motion = found;
    $("motion-words").textContent = `Self-motion: ${found.poses.length} poses of ${whose} with the same six leg lengths (to ${show(found.length_error, 2)} of the size), `
      + (found.closed ? "a closed curve." : `a curve that is followed to where it is ${found.end}.`)
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

  /** What takes longer, when the sliders rest; said when somebody has changed an offset. */
  slow(said = false) {
    this.tasks.worst.ask(this.core, { op: "worst", chosen: this.chosen }, (worst) => {
      this.worst = worst;
      this.soon();
      if (said) this.speak();
    });
    if (this.pattern && this.pattern.offsets.length > 1) {
      const { low, high, points } = PLANE;
      const plane = this.core.ask({ op: "plane", chosen: this.chosen, axes: this.plane.axes, range: [low, high], points });
      this.planeAnswer = plane;
    }
    this.soon();
  },

  /** The numbers after a change, for those who do not see them. */
  speak() {
    if (!this.state || !this.pattern) return;
    const state = this.core.ask({ op: "state", pose: this.pose, chosen: this.chosen });
    if (!state.error) $("live").textContent = `det A ${show(state.map.det, 4)}, worst conditioning of the equivalent ${show(this.worst.second ? this.worst.second.inverse_condition : null, 3)}`;
  },

  findModes() {
    const { pose } = this;
    this.tasks.modes.ask(this.core, { op: "modes", pose, which: "first" }, (found) => {
      this.modes = found;
      this.compared = -1;
      this.shown = -1;
      this.listed = this.pose === pose ? "here" : "stale";
      this.listModes();
      this.soon();
    });
  },

  /** All poses for lengths that somebody typed; the first real one is shown. */
  findFor(text) {
    const lengths = text.split(/[\s,;]+/).filter(Boolean).map(Number);
    if (lengths.length !== 6 || !lengths.every((l) => Number.isFinite(l) && l > 0)) {
      $("modes-words").textContent = "Give six positive numbers.";
      return;
    }
    this.player.rest(0);
    this.leaveMotion();
    const { pose } = this;
    this.tasks.modes.ask(this.core, { op: "modes", pose, lengths, which: "first" }, (found) => {
      this.modes = found;
      this.compared = -1;
      this.shown = -1;
      this.listed = "stale";
      // who has moved the platform meanwhile is not taken from there
      if (!found.error && found.modes.length && this.pose === pose) {
        this.shown = 0;
        this.listed = "here";
        this.pose = found.modes[0].pose;
      }
      this.listModes();
      this.soon();
    });
  },

  listModes() {
    const { modes } = this;
    if (!modes || modes.error || !modes.modes.length) $("modes").replaceChildren();
    else Tables.modes(this.open, modes, this.here(), this.compared, (name, k) => this.chooseMode(name, k));
    // while others are looked for, that is said
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
    const of = this.pattern ? "the original" : "the platform";
    const count = modes.solution_set === "positive_dimensional"
      ? `For exactly these lengths ${of} has a whole curve of complex poses; ${modes.modes.length ? `${modes.modes.length} real ones on it are listed` : "no real one was found on it"}. Isolated poses beside the curve (the one shown may be one) are not listed: move the platform a little and ask again.`
      : `${modes.modes.length} real of ${modes.finite} finite complex poses of ${of}, by the ${modes.method} method; the list is ${modes.proved ? "proved complete" : "not proved complete"}, ${modes.modes.filter((m) => m.certified).length} real ones are certified.`;
    return this.listed === "stale" ? `${count} These are the poses for the lengths at which they were found; the platform has moved since.` : count;
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
      this.shown = k;
      this.listed = "here";
      this.pose = this.modes.modes[k].pose;
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
      this.core = this.core.replace({ design: await file.text(), trajectory: [], start: null });
    } catch (error) {
      $("files-words").textContent = `${file.name}: ${error.message}`;
      return;
    }
    this.player.rest(0);
    Object.values(this.tasks).forEach((task) => task.drop());
    this.begin();
    this.views.forEach((v) => { v.scene = this.scene; });
    this.rebuild();
    $("files-words").textContent = `${file.name} is open.`;
  },
});

openCore().then((core) => {
  if (!core.live) {
    $("note").hidden = false;
    $("note").textContent = `This page shows recorded data: ${core.why}. It has one round of poses, the assembly modes at home and det A over two offsets; sliders need the core in WebAssembly.`;
  }
  $("about").textContent = `equipod ${data.version}. ${core.live ? "Every number is computed here by its core, compiled to WebAssembly; nothing is sent anywhere." : "Recorded data."}`;
  new App(core);
  document.documentElement.dataset.ready = core.live ? "live" : "recorded";
});
