// The viewpoint of the picture: one camera for both views, turned by pointer and keys.

const START = { azimuth: -0.95, elevation: 0.42, zoom: 1 };

/** Directions among which the first one is chosen. */
const AROUND = { azimuths: 48, elevations: [0.3, 0.42, 0.55, 0.7, 0.85] };
/** Sampled points of a leg, and the distance, as a share of the picture, at which two legs no longer hide each other. */
const [ALONG, APART] = [[0.15, 0.3, 0.45, 0.6, 0.75, 0.85], 0.035];

/** The distance of a point from a line between two points of the page. */
function fromLine(p, a, b) {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const t = Math.max(0, Math.min(1, ((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy || 1)));
  return Math.hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

class Camera {
  constructor(changed) {
    this.start = { ...START };
    Object.assign(this, this.start);
    this.changed = changed;
    this.pointers = new Map();
    this.spread = 0;
  }

  reset() {
    Object.assign(this, this.start);
    this.changed();
  }

  /** Begins where the legs of all these platforms hide each other least. */
  look(platforms, scene, thickness) {
    let best = -1;
    const apart = Math.max(APART, (0.5 * thickness) / scene.radius);
    for (let k = 0; k < AROUND.azimuths; k += 1) {
      for (const elevation of AROUND.elevations) {
        const azimuth = START.azimuth + (2 * Math.PI * k) / AROUND.azimuths;
        Object.assign(this, { azimuth, elevation, zoom: START.zoom });
        const project = this.projection(scene.centre, scene.radius, 1, 1);
        const seen = Math.min(...platforms.map((p) => Camera.seen(p, project, apart)));
        if (seen > best + 1e-3) {
          best = seen;
          this.start = { azimuth, elevation, zoom: START.zoom };
        }
      }
    }
    this.reset();
  }

  /** How much is seen of the leg that is hidden most, and a little of all. */
  static seen(platform, project, apart) {
    const legs = platform.legs.map(([a, b]) => [platform.base[a].at, platform.platform[b].at]);
    const flat = legs.map((ends) => ends.map(project));
    const shares = legs.map(([a, b], k) => {
      const free = ALONG.map((t) => {
        const p = project(a.map((x, i) => x + t * (b[i] - x)));
        const gap = Math.min(...flat.map(([c, d], j) => (j === k ? Infinity : fromLine(p, c, d))));
        return Math.min(1, gap / apart);
      });
      return free.reduce((sum, x) => sum + x, 0) / free.length;
    });
    return Math.min(...shares) + 0.05 * shares.reduce((sum, x) => sum + x, 0);
  }

  turn(azimuth, elevation) {
    this.azimuth += azimuth;
    this.elevation = Math.max(-1.55, Math.min(1.55, this.elevation + elevation));
    this.changed();
  }

  scale(factor) {
    this.zoom = Math.max(0.35, Math.min(6, this.zoom * factor));
    this.changed();
  }

  /** Drag, pinch, wheel with the view in focus, and keys on a canvas. */
  attach(canvas) {
    canvas.addEventListener("pointerdown", (e) => {
      canvas.setPointerCapture(e.pointerId);
      this.pointers.set(e.pointerId, [e.clientX, e.clientY]);
      this.spread = 0;
    });
    canvas.addEventListener("pointermove", (e) => this.moved(e));
    for (const end of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(end, (e) => {
        this.pointers.delete(e.pointerId);
        this.spread = 0;
      });
    }
    const wheel = (e) => {
      if (document.activeElement !== canvas && !e.ctrlKey) return;
      e.preventDefault();
      this.scale(Math.exp(-e.deltaY * 0.0012));
    };
    canvas.addEventListener("wheel", wheel, { passive: false });
    canvas.addEventListener("keydown", (e) => this.key(e));
  }

  moved(e) {
    const last = this.pointers.get(e.pointerId);
    if (!last) return;
    this.pointers.set(e.pointerId, [e.clientX, e.clientY]);
    if (this.pointers.size === 1) {
      this.turn((last[0] - e.clientX) * 0.009, (e.clientY - last[1]) * 0.009);
      return;
    }
    const [p, q] = [...this.pointers.values()];
    const spread = Math.hypot(p[0] - q[0], p[1] - q[1]);
    if (this.spread > 0) this.scale(spread / this.spread);
    this.spread = spread;
  }

  key(e) {
    const step = e.shiftKey ? 0.25 : 0.07;
    const keys = {
      ArrowLeft: () => this.turn(-step, 0), ArrowRight: () => this.turn(step, 0),
      ArrowUp: () => this.turn(0, step), ArrowDown: () => this.turn(0, -step),
      "+": () => this.scale(1.12), "=": () => this.scale(1.12), "-": () => this.scale(1 / 1.12), 0: () => this.reset(),
    };
    if (!keys[e.key] || e.ctrlKey || e.metaKey || e.altKey) return;
    e.preventDefault();
    keys[e.key]();
  }

  /** From design units to the page: x and y in pixels, depth away from the eye, pixels for one unit there. */
  projection(centre, radius, width, height) {
    const [sa, ca] = [Math.sin(this.azimuth), Math.cos(this.azimuth)];
    const [se, ce] = [Math.sin(this.elevation), Math.cos(this.elevation)];
    const eye = 4.2 * radius;
    const scale = (0.43 * Math.min(width, height) * this.zoom) / radius;
    return (p) => {
      const [x, y, z] = [p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]];
      const right = -sa * x + ca * y;
      const toward = ca * x + sa * y;
      const up = ce * z - se * toward;
      const depth = eye - (ce * toward + se * z);
      const pixels = (scale * eye) / Math.max(depth, 0.05 * eye);
      return { x: width / 2 + right * pixels, y: height / 2 - up * pixels, depth, pixels };
    };
  }
}
