// Tables of a dataset (t_ns, columns ...), of any length: what is needed is read, by blocks, and forgotten again.

import { numberAt } from "./numbers.js";

const NEWLINE = 10, COMMA = 44, RETURN = 13;
export const BLOCK_BYTES = 1 << 18;
const HEAD_BYTES = 1 << 16;
const LONGEST_LINE = 1 << 14;
/** Blocks that all tables keep together, 24 MB of text, about as much again as numbers. */
const MOST_BLOCKS = 96;
/** A table or a stretch of one up to this is read whole. */
const WHOLE_BYTES = 8 << 20;
const BUCKETS = 1 << 14;

/** Blocks by use, the last used last. */
const kept = new Map();

function keep(key, block) {
  kept.delete(key);
  kept.set(key, block);
  if (kept.size > MOST_BLOCKS) kept.delete(kept.keys().next().value);
}

/** Rows that begin in bytes[begin, end), their times later by `shift_ns`: { t_ns, values: one array a column }. */
export function parseRows(bytes, begin, end, columns, shift_ns = 0) {
  let rows = 0;
  for (let i = begin; i < end; ++i) if (bytes[i] === NEWLINE) ++rows;
  ++rows;
  const t_ns = new Float64Array(rows), values = Array.from({ length: columns }, () => new Float64Array(rows));
  let row = 0, i = begin;
  while (i < end) {
    let field = 0, from = i, stop = false;
    while (!stop) {
      const c = i < bytes.length ? bytes[i] : NEWLINE;
      if (c === COMMA || c === NEWLINE) {
        const to = i > from && bytes[i - 1] === RETURN ? i - 1 : i;
        const number = numberAt(bytes, from, to);
        if (field === 0) t_ns[row] = number + shift_ns;
        else if (field <= columns) values[field - 1][row] = number;
        ++field;
        from = i + 1;
        stop = c === NEWLINE;
      }
      ++i;
    }
    if (field > columns || (columns === 0 && field === 1)) ++row;
  }
  return { t_ns: t_ns.subarray(0, row), values: values.map((v) => v.subarray(0, row)) };
}

/** Index of the last entry of an increasing array that is not above x, or -1. */
export function lastNotAbove(sorted, x) {
  let low = 0, high = sorted.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] <= x) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** Lowest and highest of each stretch of time over a whole table, filled as it is read through. */
class Envelope {
  constructor(first_ns, last_ns, columns) {
    this.first_ns = first_ns;
    this.step_ns = (last_ns - first_ns) / BUCKETS || 1;
    this.low = Array.from({ length: columns }, () => new Float32Array(BUCKETS).fill(NaN));
    this.high = Array.from({ length: columns }, () => new Float32Array(BUCKETS).fill(NaN));
  }

  add(block) {
    for (let c = 0; c < this.low.length; ++c) {
      const low = this.low[c], high = this.high[c], values = block.values[c];
      for (let r = 0; r < values.length; ++r) {
        const b = Math.min(BUCKETS - 1, Math.max(0, Math.floor((block.t_ns[r] - this.first_ns) / this.step_ns)));
        const v = values[r];
        if (!(low[b] <= v)) low[b] = v;
        if (!(high[b] >= v)) high[b] = v;
      }
    }
  }
}

export class Table {
  /** Times are those of the file later by `shift_ns`. */
  constructor(files, path, bytes, shift_ns) {
    this.files = files;
    this.shift_ns = shift_ns;
    this.path = path;
    this.bytes = bytes;
    this.envelope = null;
    this.share_read = 0;
    this.firsts_ns = new Map();
  }

  /** Reads the head and the tail. */
  async open() {
    const head = await this.files.read(this.path, 0, Math.min(HEAD_BYTES, this.bytes));
    const end = head.indexOf(NEWLINE);
    if (end < 0) throw new Error(`${this.path}: has no line of column names`);
    const names = new TextDecoder().decode(head.subarray(0, end)).trim().split(",");
    this.columns = names.slice(1);
    this.body = end + 1;
    this.blocks = Math.max(1, Math.ceil((this.bytes - this.body) / BLOCK_BYTES));
    const first = parseRows(head, this.body, Math.min(head.length, this.body + 4096), this.columns.length, this.shift_ns);
    this.is_empty = first.t_ns.length === 0 || !(first.t_ns[0] === first.t_ns[0]);
    if (this.is_empty) return this;
    this.first_ns = first.t_ns[0];
    const last = await this.block(this.blocks - 1);
    this.last_ns = last.t_ns.length ? last.t_ns[last.t_ns.length - 1] : (await this.block(this.blocks - 2)).t_ns.at(-1);
    return this;
  }

  /** A line belongs to the block in which it begins. */
  async block(k) {
    const key = `${this.files.base}|${this.path}|${k}`;
    const known = kept.get(key);
    if (known) {
      keep(key, known);
      return known;
    }
    const begin = this.body + k * BLOCK_BYTES, end = Math.min(this.bytes, begin + BLOCK_BYTES);
    const from = k === 0 ? begin : begin - 1;
    const bytes = await this.files.read(this.path, from, Math.min(this.bytes, end + LONGEST_LINE));
    const start = k === 0 ? 0 : bytes.indexOf(NEWLINE) + 1;
    const block = parseRows(bytes, start === 0 && k > 0 ? bytes.length : start, end - from, this.columns.length, this.shift_ns);
    if (block.t_ns.length) this.firsts_ns.set(k, block.t_ns[0]);
    keep(key, block);
    return block;
  }

  /** The block that holds the last row not after t, by interpolation between blocks that are known. */
  async blockAt(t_ns) {
    let low = 0, high = this.blocks - 1, low_ns = this.first_ns, high_ns = this.last_ns;
    while (low < high) {
      const share = high_ns > low_ns ? (t_ns - low_ns) / (high_ns - low_ns) : 0;
      let guess = low + Math.floor(Math.min(1, Math.max(0, share)) * (high - low + 1));
      guess = Math.min(high, Math.max(low, guess));
      const block = await this.block(guess);
      const first = block.t_ns[0], last = block.t_ns[block.t_ns.length - 1];
      if (t_ns < first && guess > low) {
        high = guess - 1;
        high_ns = first;
      } else if (t_ns > last && guess < high) {
        const next = await this.block(guess + 1);
        if (!(next.t_ns[0] <= t_ns)) return guess;
        low = guess + 1;
        low_ns = next.t_ns[0];
      } else {
        return guess;
      }
    }
    return low;
  }

  /** The row in force at t (the first where there is none before), and the next one. */
  async around(t_ns) {
    if (this.is_empty) return null;
    const k = await this.blockAt(t_ns), block = await this.block(k);
    const r = Math.max(0, lastNotAbove(block.t_ns, t_ns));
    const row = (from, index) => ({ t_ns: from.t_ns[index], values: from.values.map((v) => v[index]) });
    const now = row(block, r);
    if (r + 1 < block.t_ns.length) return { now, next: row(block, r + 1) };
    if (k + 1 < this.blocks) {
      const following = await this.block(k + 1);
      if (following.t_ns.length) return { now, next: row(following, 0) };
    }
    return { now, next: null };
  }

  /** Whether rows between two times are few enough to be read. */
  isShort(from_ns, to_ns) {
    const span = Math.max(1, this.last_ns - this.first_ns);
    const share = Math.min(1, Math.max(0, (Math.min(to_ns, this.last_ns) - Math.max(from_ns, this.first_ns)) / span));
    return this.bytes * share <= WHOLE_BYTES;
  }

  async rowsBetween(from_ns, to_ns, visit) {
    if (this.is_empty) return;
    const first = await this.blockAt(Math.max(from_ns, this.first_ns));
    for (let k = first; k < this.blocks; ++k) {
      const block = await this.block(k);
      if (!block.t_ns.length || block.t_ns[0] > to_ns) return;
      const begin = Math.max(0, lastNotAbove(block.t_ns, from_ns));
      const end = Math.min(block.t_ns.length, lastNotAbove(block.t_ns, to_ns) + 2);
      visit(block, begin, end);
    }
  }

  /**
   * Lines of columns over [from, to], at most 2 n points each: every row where there are no more, else the lowest and the highest
   * of n stretches. `complete` is false while an overview is of rows here and there, until refine() has read all.
   */
  async series(columns, from_ns, to_ns, n) {
    if (this.is_empty) return { t_s: new Float64Array(0), values: columns.map(() => new Float64Array(0)), complete: true };
    if (!this.isShort(from_ns, to_ns)) return this.overview(columns, from_ns, to_ns, n);
    const t = [], values = columns.map(() => []);
    await this.rowsBetween(from_ns, to_ns, (block, begin, end) => {
      for (let r = begin; r < end; ++r) t.push(block.t_ns[r]);
      columns.forEach((c, j) => {
        for (let r = begin; r < end; ++r) values[j].push(block.values[c][r]);
      });
    });
    return { ...thinned(t, values, n), complete: true };
  }

  async overview(columns, from_ns, to_ns, n) {
    if (!this.envelope) {
      this.envelope = new Envelope(this.first_ns, this.last_ns, this.columns.length);
      const probes = 64;
      for (let p = 0; p < probes; ++p) {
        this.envelope.add(await this.block(Math.floor((p * (this.blocks - 1)) / (probes - 1))));
      }
    }
    const { first_ns, step_ns } = this.envelope;
    const begin = Math.max(0, Math.floor((from_ns - first_ns) / step_ns));
    const end = Math.min(BUCKETS, Math.ceil((to_ns - first_ns) / step_ns) + 1);
    const stride = Math.max(1, Math.ceil((end - begin) / n));
    const t = [], values = columns.map(() => []);
    for (let b = begin; b < end; b += stride) {
      const until = Math.min(end, b + stride);
      let any = false;
      const extremes = columns.map((c) => {
        let low = NaN, high = NaN;
        for (let k = b; k < until; ++k) {
          const l = this.envelope.low[c][k], h = this.envelope.high[c][k];
          if (l === l) {
            any = true;
            if (!(low <= l)) low = l;
            if (!(high >= h)) high = h;
          }
        }
        return [low, high];
      });
      if (!any) continue;
      t.push(first_ns + (b + 0.25 * (until - b)) * step_ns, first_ns + (b + 0.75 * (until - b)) * step_ns);
      extremes.forEach(([low, high], j) => values[j].push(low, high));
    }
    return { t_s: Float64Array.from(t, (x) => 1e-9 * x), values: values.map((v) => Float64Array.from(v)), complete: this.share_read >= 1 };
  }

  /** Reads on through a long table for its overview; true while there is more. */
  async refine(blocks) {
    if (!this.envelope || this.share_read >= 1) return false;
    this.next = this.next ?? 0;
    for (let k = 0; k < blocks && this.next < this.blocks; ++k, ++this.next) {
      const key = `${this.files.base}|${this.path}|${this.next}`;
      const was_kept = kept.has(key);
      this.envelope.add(await this.block(this.next));
      if (!was_kept) kept.delete(key);
    }
    this.share_read = this.next / this.blocks;
    return this.share_read < 1;
  }
}

/** All points, or of n stretches of equally many rows the lowest and the highest in their order. */
export function thinned(t_ns, values, n) {
  const rows = t_ns.length;
  if (rows <= 2 * n) {
    return { t_s: Float64Array.from(t_ns, (x) => 1e-9 * x), values: values.map((v) => Float64Array.from(v)), all: true };
  }
  const t_s = new Float64Array(2 * n), thin = values.map(() => new Float64Array(2 * n));
  for (let k = 0; k < n; ++k) {
    const begin = Math.floor((k * rows) / n), end = Math.floor(((k + 1) * rows) / n);
    t_s[2 * k] = 1e-9 * t_ns[begin];
    t_s[2 * k + 1] = 1e-9 * t_ns[end - 1];
    values.forEach((v, j) => {
      let low = begin, high = begin;
      for (let r = begin + 1; r < end; ++r) {
        if (v[r] < v[low]) low = r;
        if (v[r] > v[high]) high = r;
      }
      thin[j][2 * k] = v[Math.min(low, high)];
      thin[j][2 * k + 1] = v[Math.max(low, high)];
    });
  }
  return { t_s, values: thin, all: false };
}
