// Time: runs through poses and tells which one is shown.

const ROUND_SECONDS = 14;

class Player {
  /** `moved(at)` is called with the share of the way, in [0, 1), `paused()` when the platform comes to rest. */
  constructor(moved, paused) {
    Object.assign(this, { moved, paused });
    this.at = 0;
    this.running = false;
    this.speed = 1;
    this.back = false;
    $("play").addEventListener("click", () => this.toggle());
    $("way").addEventListener("input", () => this.jump(Number($("way").value)));
    $("speed").addEventListener("change", () => { this.speed = Number($("speed").value); });
  }

  toggle(on = !this.running) {
    const before = this.running;
    this.running = on;
    if (before && !on) this.paused();
    $("play").textContent = on ? "Pause" : "Play";
    this.last = performance.now();
    if (on) requestAnimationFrame((now) => this.frame(now));
  }

  frame(now) {
    if (!this.running) return;
    this.at = (this.at + ((now - this.last) / 1000 / ROUND_SECONDS) * this.speed) % 1;
    this.last = now;
    this.place(this.at);
    this.moved(this.at);
    requestAnimationFrame((next) => this.frame(next));
  }

  jump(at) {
    this.at = Math.min(at, 0.999999);
    this.place(at);
    this.moved(this.at);
  }

  /** Shows a place without calling anybody. */
  rest(at) {
    this.toggle(false);
    this.at = at;
    this.place(at);
  }

  place(at) {
    $("way").value = at;
    $("way").setAttribute("aria-valuetext", `${Math.round(100 * at)} percent of the way`);
  }
}
