// Calls to the page's workers. One reads tables, the others frames, so that a plot never waits for a picture.

import text from "tera-worker/worker.txt";

class Lane {
  constructor(url) {
    this.worker = new Worker(url);
    this.waiting = new Map();
    this.next = 0;
    this.worker.onmessage = ({ data: { id, result, error } }) => {
      const { resolve, reject } = this.waiting.get(id);
      this.waiting.delete(id);
      if (error === undefined) resolve(result);
      else reject(new Error(error));
    };
  }

  call(method, args, transfer = []) {
    return new Promise((resolve, reject) => {
      const id = this.next++;
      this.waiting.set(id, { resolve, reject });
      this.worker.postMessage({ id, method, args }, transfer);
    });
  }
}

const TABLES = new Set(["table", "series", "refine", "rows", "difference"]);

export class Calls {
  constructor(frame_lanes = 2) {
    const url = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
    this.tables = new Lane(url);
    this.frames = Array.from({ length: frame_lanes }, () => new Lane(url));
  }

  /** To all: what there is to be read. */
  open(args) {
    return Promise.all([this.tables, ...this.frames].map((lane) => lane.call("open", args)));
  }

  /** Whether anything waits for a table; who reads on for later only lets it go first. */
  get is_asked() {
    return this.tables.waiting.size > 0;
  }

  call(method, args) {
    if (TABLES.has(method)) return this.tables.call(method, args);
    const lane = this.frames.reduce((best, one) => (one.waiting.size < best.waiting.size ? one : best));
    return lane.call(method, args);
  }
}

/** Runs `work` for the newest wish only: those that come while it runs replace each other. */
export class Newest {
  constructor(work) {
    this.work = work;
    this.is_running = false;
    this.wish = null;
  }

  async ask(...args) {
    this.wish = args;
    if (this.is_running) return;
    this.is_running = true;
    try {
      while (this.wish) {
        const now = this.wish;
        this.wish = null;
        try {
          await this.work(...now);
        } catch (error) {
          console.warn(error.message);
        }
      }
    } finally {
      this.is_running = false;
    }
  }

  get is_busy() {
    return this.is_running;
  }
}
