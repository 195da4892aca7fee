// The requirements over the whole workspace: what `equipod assess` answers for the design shown.

/** A quick look first; then the numbers of poses, searches and cells that `equipod assess` begins with: a page cannot go on for minutes. */
const ROUGH = { points: 500, searches: 1, cells: 0 };
const THOROUGH = { points: 5000, searches: 3, cells: 6000 };

/** What is known of a margin over the workspace, in a word. */
const VERDICTS = { met: "proved", at_limit: "at the limit", violated: "violated", searched: "not proved" };

const Limits = {
  /** The badge of the page: class and words for the design shown. */
  verdict({ app, state }) {
    const { open, limits } = app;
    const second = state.platforms.length > 1;
    const singular = second ? Limits.singular(app, state) : open.singular;
    if (singular) return ["bad", "architecturally singular"];
    if (!second && open.singular === null && open.reason) return ["", open.reason];
    if (!limits) return ["", app.core.live ? "workspace: checking .." : "workspace: not checked"];
    if (limits.error) return limits.error.code === "nothing_required" ? ["", "no requirements"] : ["", "workspace: not checked"];
    if (limits.regular.met === false) return ["bad", "singular pose in the workspace"];
    if (limits.met === false || limits.requirements.some((m) => m.met === false)) return ["bad", "violates requirements"];
    if (limits.met) return limits.assessed_poses.region ? ["good", "meets all requirements"] : ["good", `requirements ${limits.assessed_poses.met_in_words}`];
    return ["", limits.whole ? "no violation found, not all proved" : "no violation found so far"];
  },

  /** Whether the equivalent shown is singular: proved about the joints of the file where it is the design itself, else by det A. */
  singular(app, state) {
    const { start, start_singular: proved } = app.open;
    const own = proved !== null && app.pattern.id === start.pattern && app.offsets.every((t, k) => t === start.offsets[k]);
    return own ? proved : Math.abs(state.map.det) < 1e-12;
  },

  /** What the figures say of each platform by itself. */
  regularity({ app, state, k }) {
    const { open } = app;
    if (app.cranks) return Cranks.reached(state.platforms[0].cranks);
    if (k === 0 && open.singular === null) return ["", open.reason];
    if (k === 0) return open.singular ? ["bad", "architecturally singular"] : ["good", "architecturally regular"];
    if (open.singular || Limits.singular(app, state)) return ["bad", "architecturally singular"];
    return Math.abs(state.map.det) < open.limits.det ? ["bad", "close to singular"] : ["good", "architecturally regular"];
  },

  /** The sentence above the table. */
  words({ app, state }) {
    const { limits } = app;
    const whose = state.platforms.length > 1 ? "the equivalent" : "the platform";
    if (!app.core.live) return "The least margin of each requirement at the pose shown, not over the workspace; below zero the requirement is violated.";
    if (!limits) return `Margins at the pose shown; the workspace of ${whose} is being checked.`;
    if (limits.error) return limits.error.code === "nothing_required" ? "The design requires nothing: it has no [hardware], loads or keep-outs." : limits.error.message;
    const over = limits.assessed_poses.stated ? `over ${limits.poses} poses of the workspace` : "at home";
    if (!limits.whole) return `Least margins of ${whose} ${over}; ${Task.possible ? "more poses and a proof are on their way" : "a browser with workers looks at more of them"}.`;
    return `Least margins of ${whose}, which ${limits.explanation}; below zero a requirement is violated.`;
  },

  /** The cell of a requirement over the workspace. */
  cell(m, go) {
    if (!m) return ["–"];
    const number = m.at_limit ? "0" : show(m.margin, 4);
    const tone = m.met ? "good" : m.met === false ? "bad" : null;
    const word = VERDICTS[m.status] || m.status;
    const where = m.pose ? [Limits.button(m.pose, go)] : [];
    return [el("span", { class: tone }, `${number} ${word}`), el("small", {}, m.between.join(", ")), ...where];
  },

  /** The row of the singular poses. */
  regular({ regular: found, regular_explanation: text }, go) {
    const tone = { proved: "good", changes_sign: "bad" }[found.status] || null;
    return [el("span", { class: tone }, text), ...(found.pose ? [Limits.button(found.pose, go)] : [])];
  },

  /** The cell of the worst conditioning found; nothing limits it. */
  conditioning(found, go) {
    return [el("span", {}, `${show(found.inverse_condition, 3)} least found`), Limits.button(found.pose, go)];
  },

  button(pose, go) {
    return el("button", { type: "button", class: "plain", click: () => go(pose) }, "show pose");
  },
};
