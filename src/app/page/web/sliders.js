// One slider and one number field for every offset.

const SLIDE = { low: -0.5, high: 1.5, step: 0.01 };

class Sliders {
  /** `set(changes)` takes pairs of an offset and its value. */
  constructor(box, set) {
    this.box = box;
    this.set = set;
  }

  build(open, pattern, enabled) {
    this.units = open.units;
    this.rows = pattern.offsets.map((offset, k) => this.row(offset, k, pattern, open.hexagon.sides[offset.side], enabled));
    this.box.replaceChildren(...this.rows.map((r) => r.node));
  }

  row(offset, k, pattern, side, enabled) {
    const leg = pattern.legs.find((l) => l.offset === k);
    const id = `offset-${offset.name}`;
    const words = `${offset.joint} from ${side.from} to ${side.to} (${side.body}), ${show(side.length, 4)}${unit(this.units)}`;
    const range = el("input", {
      type: "range", id, min: SLIDE.low, max: SLIDE.high, step: SLIDE.step, disabled: !enabled, "aria-describedby": `${id}-what`,
      input: () => this.set([[k, Number(range.value)]]),
    });
    const field = el("input", {
      type: "number", step: SLIDE.step, disabled: !enabled, "aria-label": `${offset.name} as a number`,
      change: () => field.value !== "" && Number.isFinite(Number(field.value)) && this.set([[k, Number(field.value)]]),
    });
    const mark = el("span", { class: "mark", "aria-hidden": "true" });
    const zero = el("button", { type: "button", disabled: !enabled, click: () => this.set([[k, this.zeros[k]]]) });
    const node = el("div", { class: "slider" },
      el("div", { class: "what" }, el("label", { for: id }, ...this.title(offset, leg)), el("span", { id: `${id}-what` }, words)),
      el("div", { class: "track" }, mark, range), field, zero);
    return { node, range, field, mark, zero, name: offset.name, side };
  }

  title(offset, leg) {
    return [el("span", { class: "dot", style: `background:${legColour(leg.leg)}`, "aria-hidden": "true" }), `${offset.name}, leg ${leg.leg}`];
  }

  update(offsets, zeros) {
    this.zeros = zeros || [];
    this.rows.forEach((r, k) => {
      if (Number(r.range.value) !== offsets[k]) r.range.value = offsets[k];
      if (document.activeElement !== r.field) r.field.value = String(Number(offsets[k].toPrecision(7)));
      r.range.setAttribute("aria-valuetext", `${show(offsets[k])} of the edge from ${r.side.from} to ${r.side.to}`);
      const zero = this.zeros[k];
      const there = zero !== null && zero !== undefined;
      const share = (zero - SLIDE.low) / (SLIDE.high - SLIDE.low);
      r.mark.hidden = !there || share < 0 || share > 1;
      // the middle of the thumb, half a thumb from the ends
      r.mark.style.left = `calc(${share} * (100% - 16px) + 8px)`;
      r.zero.textContent = there ? `→ ${fixed(zero, 3)}` : "no zero";
      r.zero.title = there ? `to ${fixed(zero, 3)}, where det A is 0` : "";
      r.zero.setAttribute("aria-label", there ? `set ${r.name} to ${fixed(zero, 3)}, where det A is 0` : "det A does not depend on it");
      r.zero.disabled = !there || r.range.disabled;
    });
  }
}
