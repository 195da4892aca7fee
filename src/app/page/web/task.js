// Long computations: each has a core of its own in a worker, so that the page stays usable meanwhile. Where there can be no workers the page computes.

/** Milliseconds after which it is said that something is being computed: shorter ones would only flicker. */
const TOLD_AFTER = 300;

/** What a worker runs. The first message brings module and design, every other one a request. */
function serve() {
  let core = null;
  self.onmessage = ({ data }) => {
    if (data.module) core = new Live(data.module, data.opening);
    else self.postMessage({ number: data.number, answer: core.ask(data.request) });
  };
}

class Task {
  /** `wait()` is called when an answer takes long enough to be told of; `word` is what is said on the root element meanwhile. */
  constructor(wait, word = "busy") {
    this.wait = wait;
    this.word = word;
    this.number = 0;
    this.job = null;
    this.worker = null;
  }

  /** Asks, at once or after some milliseconds, and forgets what was asked before: `done(answer)` is called for the newest request only. */
  ask(core, request, done, after = 0) {
    this.drop();
    if (this.core !== core) this.close();
    this.core = core;
    this.job = { number: this.number += 1, request, done, sent: false };
    Task.working.add(this);
    Task.mark();
    if (after) this.asked = setTimeout(() => this.send(), after);
    else this.send();
  }

  send() {
    const { number, request } = this.job;
    this.job.sent = true;
    this.told = setTimeout(() => this.wait(), TOLD_AFTER);
    if (this.open()) {
      this.worker.postMessage({ number, request });
      return;
    }
    setTimeout(() => this.job?.number === number && this.answered(number, this.core.ask(request)));
  }

  answered(number, answer) {
    const { job } = this;
    if (!job || job.number !== number) return;
    this.over();
    job.done(answer);
  }

  /** Breaks off what is being computed; nobody wants the answer. `true` when there was something. */
  drop() {
    const had = this.job !== null;
    if (had) {
      if (this.job.sent) this.close();
      this.over();
    }
    return had;
  }

  over() {
    this.job = null;
    clearTimeout(this.told);
    clearTimeout(this.asked);
    Task.working.delete(this);
    Task.mark();
  }

  close() {
    this.worker?.terminate();
    this.worker = null;
  }

  /** A worker with the design open; `false` where there can be none. */
  open() {
    if (this.worker) return true;
    if (!Task.possible || !this.core.live) return false;
    try {
      Task.address ||= URL.createObjectURL(new Blob([`"use strict";\n${foreign}\n${Live}\n(${serve})();`], { type: "text/javascript" }));
      const worker = new Worker(Task.address);
      worker.onmessage = ({ data }) => worker === this.worker && this.answered(data.number, data.answer);
      worker.onerror = worker.onmessageerror = (e) => {
        e.preventDefault();
        if (worker === this.worker) this.without();
      };
      worker.postMessage({ module: this.core.module, opening: this.core.opening });
      this.worker = worker;
    } catch {
      Task.possible = false;
    }
    return Task.possible;
  }

  /** A worker that does not start, or broke down: from now on the page computes. */
  without() {
    Task.possible = false;
    this.close();
    if (this.job?.sent) this.send();
  }

  /** Says on the root element whether something is being computed, and where: assessments over the workspace, which take longest, apart. */
  static mark() {
    const { dataset } = document.documentElement;
    const atWork = new Set([...Task.working].map((task) => task.word));
    for (const word of ["busy", "assessing"]) {
      if (atWork.has(word)) dataset[word] = Task.possible ? "worker" : "page";
      else delete dataset[word];
    }
  }
}

Task.working = new Set();
Task.possible = typeof Worker === "function";
