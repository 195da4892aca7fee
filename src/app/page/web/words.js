// Small words: elements, numbers, colours.

const $ = (id) => document.getElementById(id);

/** An element with attributes (a function is a listener) and children. */
function el(tag, attributes = {}, ...children) {
  const svg = ["line", "circle", "text", "g", "path", "polygon", "title"].includes(tag);
  const node = svg ? document.createElementNS("http://www.w3.org/2000/svg", tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") node.addEventListener(name, value);
    else if (name === "style") node.style.cssText = value; // the policy of the page allows no style attributes
    else if (value === true) node.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) node.setAttribute(name, value);
  }
  node.append(...children.filter((c) => c !== null && c !== undefined));
  return node;
}

/** A number with six significant digits, in words where it is none. */
function show(x, digits = 6) {
  if (x === null || x === undefined) return "–";
  if (x === 0) return "0";
  const size = Math.abs(x);
  const text = size >= 1e6 || size < 1e-4 ? x.toExponential(Math.max(1, digits - 3)) : String(Number(x.toPrecision(digits)));
  return text.replaceAll("-", "−");
}

/** A number with so many decimals; no minus before a zero. */
const fixed = (x, digits) => (x === null ? "–" : (Number(x.toFixed(digits)) + 0 || 0).toFixed(digits).replace("-", "−"));

/** The unit behind a heading; a design in pure numbers has none. */
const inUnits = (units) => (units === "1" ? "" : ` [${units}]`);

/** The unit behind a number. */
const unit = (units) => (units === "1" ? "" : ` ${units}`);

const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

const legColour = (leg) => `var(--leg-${leg})`;

/** A coloured dot with the number of a leg. */
function legName(leg) {
  return [el("span", { class: "dot", style: `background:${legColour(leg)}`, "aria-hidden": "true" }), `leg\u00a0${leg}`];
}

/** A table row; the first cell is the heading of the row. */
function row(cells, attributes = {}) {
  const node = (content, k) => {
    const parts = Array.isArray(content) ? content : [content];
    return k === 0 ? el("th", { scope: "row" }, ...parts) : el("td", {}, ...parts);
  };
  return el("tr", attributes, ...cells.map(node));
}

function heading(cells) {
  return el("thead", {}, el("tr", {}, ...cells.map((c, k) => el("th", { scope: "col", class: k ? null : "left" }, c))));
}

/** Runs at most once in a while: at the end of a burst of calls. */
function later(milliseconds, run) {
  let timer = 0;
  return () => {
    clearTimeout(timer);
    timer = setTimeout(run, milliseconds);
  };
}

/** A canvas in pixels of the screen; its context, and its size in pixels of the page. */
function fitted(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const { clientWidth: width, clientHeight: height } = canvas;
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return { context, width, height };
}
