// The requirements over the whole workspace: what `equipod assess` answers for the design shown.

/** A quick check first; then the numbers of poses, searches and cells that `equipod assess` begins with: a page cannot go on for minutes. */
const ROUGH = { points: 500, searches: 1, cells: 0 };
const THOROUGH = { points: 5000, searches: 3, cells: 6000 };

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
    const atHome = limits.workspace === "none" && limits.requirements.every((m) => m.met) && limits.regular.met;
    if (limits.met || atHome) return limits.assessed_poses.region ? ["good", "meets all requirements"] : ["good", `requirements ${limits.assessed_poses.met_in_words}`];
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
    if (limits.error) return limits.error.code === "nothing_required" ? "The design has no requirements: no [hardware], loads or keep-outs." : limits.error.message;
    const over = limits.assessed_poses.stated ? `over ${limits.poses} poses of the workspace` : "at home";
    if (!limits.whole) return `Least margins of ${whose} ${over}; ${Task.possible ? "more poses and a proof follow" : "a browser with workers examines more poses"}.`;
    return `Least margins of ${whose}, which ${limits.explanation}; below zero a requirement is violated.`;
  },
};
