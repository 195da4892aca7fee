// The pose as sliders and numbers, and the leg lengths: each follows from the other.

/** Numbers in a text, whatever stands between them. */
const numbersIn = (text) => text.split(/[\s,;]+/).filter(Boolean).map(Number);

/** A number for a field: enough digits to be read back as the same pose. */
const plain = (x) => String(Number(x.toPrecision(9)));

class PoseFields {
  /** `place(values)` takes position and angles in the convention of the design. */
  constructor(box, place) {
    this.box = box;
    this.place = place;
  }

  build(open, home, enabled) {
    const { slides } = open;
    const reach = [...slides.position, ...slides.angles];
    const angleUnit = open.frames.angle_unit === "rad" ? " [rad]" : " [°]";
    this.own = null;
    this.rows = open.frames.names.map((name, k) => {
      const unitHere = k < 3 ? inUnits(open.units) : angleUnit;
      const step = k < 3 || open.frames.angle_unit === "rad" ? 10 ** Math.floor(Math.log10(reach[k] / 50)) : 0.5;
      const low = home[k] - reach[k];
      const range = el("input", { type: "range", id: `pose-${name}`, min: low, max: home[k] + reach[k], step: "any", disabled: !enabled,
        input: () => this.set(k, Math.round(Number(range.value) / step) * step) });
      const field = el("input", { type: "number", step: "any", disabled: !enabled, "aria-label": `${name}${unitHere} as a number`,
        change: () => field.value !== "" && Number.isFinite(Number(field.value)) && this.set(k, Number(field.value)) });
      const node = el("div", { class: "coordinate" }, el("label", { for: `pose-${name}` }, `${name}${unitHere}`), range, field);
      return { node, range, field };
    });
    this.box.replaceChildren(...this.rows.map((r) => r.node));
  }

  set(k, value) {
    const values = [...this.values];
    values[k] = value;
    const pose = this.place(values);
    // what was typed stays as it is: two triples of angles can be one rotation
    if (!pose) return;
    this.own = { pose, values };
    // the next number may be typed before the page is drawn again
    this.values = values;
  }

  update(pose, state) {
    this.values = this.own?.pose === pose ? this.own.values : state.written;
    this.rows.forEach(({ range, field }, k) => {
      const value = Number(this.values[k].toPrecision(12));
      range.value = value;
      range.setAttribute("aria-valuetext", show(value, 5));
      if (document.activeElement !== field) field.value = plain(Math.abs(value) < 1e-12 ? 0 : value);
    });
  }
}

class LegFields {
  constructor(box, words) {
    Object.assign(this, { box, words });
    this.typed = false;
  }

  build(open, enabled) {
    this.open = open;
    this.typed = false;
    this.fields = [1, 2, 3, 4, 5, 6].map((leg) => {
      const field = el("input", { type: "text", inputmode: "decimal", autocomplete: "off", spellcheck: "false", id: `length-${leg}`, disabled: !enabled,
        input: () => this.touched(), paste: (e) => this.pasted(e) });
      return field;
    });
    this.box.replaceChildren(...this.fields.map((field, k) => el("label", { for: field.id }, el("span", {}, ...legName(k + 1)), field)));
  }

  touched() {
    this.typed = true;
    this.say();
  }

  /** Six numbers that are pasted into one field are for all of them. */
  pasted(e) {
    const list = numbersIn(e.clipboardData.getData("text"));
    if (list.length !== 6 || !list.every(Number.isFinite)) return;
    e.preventDefault();
    this.take(list);
  }

  take(lengths) {
    this.fields.forEach((field, k) => { field.value = plain(lengths[k]); });
    this.touched();
  }

  /** The six lengths, or angles of cranks, or `null` where one of them is none. */
  read() {
    const list = this.fields.map((field) => Number(field.value.trim() || "none"));
    return list.every((l) => Number.isFinite(l) && (l > 0 || this.open.angles_deg)) ? list : null;
  }

  /** `null`: a rod does not reach, and there are no angles. */
  update(lengths) {
    if (this.typed) return;
    this.fields.forEach((field, k) => {
      field.value = lengths ? plain(lengths[k]) : "";
      field.classList.toggle("bad", lengths !== null && this.beyond(lengths[k], k));
    });
    this.say(lengths);
  }

  beyond(length, k) {
    if (this.open.angles_deg) {
      const range = this.open.angles_deg[k];
      return range !== null && (length < range[0] || length > range[1]);
    }
    const { lengths } = this.open.hardware;
    return lengths !== null && (length < lengths[0] || length > lengths[1]);
  }

  sayAngles(angles) {
    const out = (angles || []).flatMap((angle, k) => (this.beyond(angle, k) ? [k + 1] : []));
    this.words.textContent = !angles ? "A rod does not reach from its crank to the platform at this pose."
      : !this.open.angles_deg.some(Boolean) ? "The design sets no limits of angles."
      : out.length ? `Beyond its limits: crank ${out.join(", ")}.` : "All six are within their limits.";
  }

  say(lengths) {
    if (this.typed) {
      this.words.textContent = `These ${this.open.angles_deg ? "angles" : "lengths"} are typed in and not yet those of a pose.`;
      return;
    }
    if (this.open.angles_deg) {
      this.sayAngles(lengths);
      return;
    }
    const { lengths: limits } = this.open.hardware;
    const out = lengths.flatMap((l, k) => (this.beyond(l) ? [k + 1] : []));
    const range = limits ? `${show(limits[0])} to ${show(limits[1])}${unit(this.open.units)}` : "";
    this.words.textContent = !limits ? "The design sets no limits of leg lengths."
      : out.length ? `Beyond the limits of ${range}: leg ${out.join(", ")}.` : `All six are within the limits of ${range}.`;
  }
}
