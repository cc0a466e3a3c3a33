// The page's worker: reads and decodes, so that the page itself only draws. Each call is {id, method, args}; its answer
// {id, result} or {id, error}.

import { paintLabel } from "./colour.js";
import { readPcd } from "./pcd.js";
import { readPng } from "./png.js";
import { PackedFiles, ServedFiles } from "./source.js";
import { Table, thinned } from "./table.js";
import { readTiff } from "./tiff.js";

let sources = [];
const tables = new Map();
const frame_lists = new Map();

function tableOf(source, path) {
  const key = `${source}|${path}`;
  if (!tables.has(key)) {
    const { files, sizes, shift_ns } = sources[source];
    tables.set(key, new Table(files, path, sizes[path], shift_ns).open());
  }
  return tables.get(key);
}

const NS = 1e9;

const methods = {
  open({ list, pack }) {
    const bytes = pack && new Uint8Array(pack.bytes);
    sources = list.map(({ base, sizes, classes, prefix, shift_ns }) => ({
      files: pack ? new PackedFiles(Object.fromEntries(Object.entries(pack.places)
        .filter(([name]) => name.startsWith(prefix)).map(([name, place]) => [name.slice(prefix.length), place])), bytes, prefix)
        : new ServedFiles(base),
      sizes, classes, shift_ns,
    }));
    return true;
  },

  /** Columns and times; of a table that cannot be read `error`, and nothing in it. */
  async table({ source, path }) {
    const table = await tableOf(source, path).catch((error) => ({ columns: [], is_empty: true, error: error.message }));
    return { error: table.error, columns: table.columns, is_empty: table.is_empty, from_s: table.first_ns / NS, to_s: table.last_ns / NS };
  },

  async series({ source, path, columns, from_s, to_s, points }) {
    const table = await tableOf(source, path);
    const picked = columns.map((name) => table.columns.indexOf(name));
    if (picked.includes(-1)) return null;
    const series = await table.series(picked, from_s * NS, to_s * NS, points);
    return { ...series, share_read: table.share_read };
  },

  /** Rows of a less those of b, which is interpolated, where b has rows about; null where the stretch is too long to be read. */
  async difference({ a, b, columns, from_s, to_s, points }) {
    const [one, other] = await Promise.all([tableOf(a.source, a.path), tableOf(b.source, b.path)]);
    if (one.is_empty || other.is_empty || !one.isShort(from_s * NS, to_s * NS) || !other.isShort(from_s * NS, to_s * NS)) return null;
    const rows = async (table) => {
      const picked = columns.map((name) => table.columns.indexOf(name)), t = [], values = columns.map(() => []);
      await table.rowsBetween(from_s * NS, to_s * NS, (block, begin, end) => {
        for (let r = begin; r < end; ++r) t.push(block.t_ns[r]);
        picked.forEach((c, j) => { for (let r = begin; r < end; ++r) values[j].push(c < 0 ? NaN : block.values[c][r]); });
      });
      return { t, values };
    };
    const [x, y] = [await rows(one), await rows(other)], t = [], values = columns.map(() => []);
    let k = 0;
    x.t.forEach((now, r) => {
      while (k + 1 < y.t.length && y.t[k + 1] <= now) ++k;
      const next = Math.min(k + 1, y.t.length - 1), gap = y.t[next] - y.t[k];
      if (now < y.t[k] || now > y.t[next]) return;
      t.push(now);
      const s = gap > 0 ? (now - y.t[k]) / gap : 0;
      columns.forEach((_, j) => values[j].push(x.values[j][r] - (y.values[j][k] + s * (y.values[j][next] - y.values[j][k]))));
    });
    const rms = values.map((v) => Math.sqrt(v.reduce((sum, d) => sum + d * d, 0) / v.length));
    return { ...thinned(t, values, points), rms };
  },

  async refine({ source, path, blocks }) {
    const table = await tableOf(source, path);
    const more = await table.refine(blocks);
    return { more, share: table.share_read };
  },

  /** Rows of several tables in force at one time: [{ t_ns, values, next }], null of one that has none. */
  async rows({ source, paths, t_s }) {
    return Promise.all(paths.map(async (path) => {
      const table = await tableOf(source, path);
      const found = await table.around(t_s * NS);
      return found && { ...found, columns: table.columns };
    }));
  },

  /** Times and names of a camera's or lidar's frames. */
  async frames({ source, path }) {
    const key = `${source}|${path}`;
    if (!frame_lists.has(key)) {
      const { files, shift_ns } = sources[source];
      const bytes = await files.read(path).catch(() => new Uint8Array(0));  // no frames, then
      const text = new TextDecoder().decode(bytes);
      const lines = text.split("\n").slice(1).filter((line) => line !== "").map((line) => line.trim().split(","));
      frame_lists.set(key, { t_s: Float64Array.from(lines, (l) => (Number(l[0]) + shift_ns) / NS), names: lines.map((l) => l[1]) });
    }
    return frame_lists.get(key);
  },

  /** A picture to draw, and of labels what its pixels say. */
  async picture({ source, path, kind }) {
    const { files, classes } = sources[source];
    const bytes = await files.read(path);
    if (bytes.length === 0) throw new Error(`${path}: is empty`);
    if (kind === "rgb") return { bitmap: await createImageBitmap(new Blob([bytes], { type: "image/png" })) };
    const picture = await readPng(bytes);
    const rgba = paintLabel(kind, picture, classes);
    const bitmap = await createImageBitmap(new ImageData(rgba, picture.width, picture.height));
    return { bitmap, ...picture };
  },

  async json({ source, path }) {
    return JSON.parse(new TextDecoder().decode(await sources[source].files.read(path)));
  },

  async scan({ source, path }) {
    try {
      return readPcd(await sources[source].files.read(path));
    } catch (error) {
      throw new Error(`${path}: ${error.message}`);
    }
  },

  async raster({ source, path }) {
    return readTiff(await sources[source].files.read(path));
  },

  async bytes({ source, path }) {
    return (await sources[source].files.read(path)).buffer;
  },
};

function buffersIn(result, found = new Set()) {
  if (result instanceof ImageBitmap) found.add(result);
  else if (result instanceof ArrayBuffer) found.add(result);
  else if (ArrayBuffer.isView(result)) found.add(result.buffer);
  else if (result && typeof result === "object") for (const value of Object.values(result)) buffersIn(value, found);
  return found;
}

self.onmessage = async ({ data: { id, method, args } }) => {
  try {
    const result = await methods[method](args);
    self.postMessage({ id, result }, method === "frames" ? [] : [...buffersIn(result)]);
  } catch (error) {
    self.postMessage({ id, error: error.message });
  }
};
