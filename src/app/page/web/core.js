// The core: answers in JSON to requests in JSON, from WebAssembly, or recorded ones where there is none.

const data = JSON.parse(document.getElementById("data").textContent);

/** The bytes of the module in the page, unpacked; nothing where the page has none. */
async function moduleBytes() {
  const text = document.getElementById("core").textContent.trim();
  if (!text) return null;
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  if (bytes[0] !== 0x1f) return bytes;
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** What the module asks for but never uses: a solver it is linked with could ask for the time. */
function foreign(module) {
  const imports = {};
  const refuse = () => { throw new Error("the core asked for something outside of it"); };
  for (const { module: from, name } of WebAssembly.Module.imports(module)) (imports[from] ||= {})[name] = refuse;
  return imports;
}

/** The core in WebAssembly. After a breakdown the next call starts a fresh instance. */
class Live {
  constructor(module, opening) {
    this.live = true;
    this.module = module;
    this.opening = opening;
    this.start();
  }

  start() {
    this.doors = new WebAssembly.Instance(this.module, foreign(this.module)).exports;
    const refused = this.call("equipod_open", JSON.stringify(this.opening));
    if (refused) throw new Error(JSON.parse(refused).error.message);
  }

  call(door, text) {
    const bytes = new TextEncoder().encode(text);
    const at = this.doors.equipod_input(bytes.length);
    new Uint8Array(this.doors.memory.buffer, at, bytes.length).set(bytes);
    const length = this.doors[door]() >>> 0;
    const from = this.doors.equipod_output() >>> 0;
    return new TextDecoder().decode(new Uint8Array(this.doors.memory.buffer, from, length));
  }

  ask(request) {
    let answer;
    try {
      if (!this.doors) this.start();
      answer = JSON.parse(this.call("equipod_answer", JSON.stringify(request)));
    } catch (error) {
      this.doors = null;
      return { error: { code: "breakdown", message: String(error) } };
    }
    return answer;
  }

  /** Another design in the place of this one; throws the reason when it is refused. */
  replace(opening) {
    return new Live(this.module, opening);
  }
}

/** Recorded answers: the poses of one round, and what was found at home with the first offsets. */
class Recorded {
  constructor(why) {
    this.live = false;
    this.why = why;
  }

  ask(request) {
    const kept = data.recorded;
    const frame = (at) => kept.frames[Math.round(at * kept.frames.length) % kept.frames.length];
    switch (request.op) {
      case "open": return kept.open;
      case "path": return frame(request.at);
      case "state": return kept.frames.find((f) => sameNumbers(f.pose, request.pose)) || kept.frames[0];
      case "worst": return kept.worst;
      case "modes": return kept.modes;
      case "plane": return kept.plane;
      case "motion": return kept.motion;
      case "derivation": return kept.derivation;
      case "design": return kept.designs[request.which];
      default: return { error: { code: "recorded", message: "not recorded" } };
    }
  }
}

function sameNumbers(a, b) {
  return JSON.stringify(a) === JSON.stringify(b);
}

async function openCore() {
  if (typeof WebAssembly !== "object") return new Recorded("this browser has no WebAssembly");
  try {
    const bytes = await moduleBytes();
    if (!bytes) return new Recorded("the page was written without the core in WebAssembly");
    return new Live(await WebAssembly.compile(bytes), data.opening);
  } catch (error) {
    return new Recorded(`the core could not be started (${error.message})`);
  }
}
