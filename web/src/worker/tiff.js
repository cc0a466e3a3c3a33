// One-band GeoTIFFs as the ground is recorded: tiles or strips, packed by deflate or not, with the predictors of TIFF.

import { inflate } from "./inflate.js";

const SIZES = { 1: 1, 2: 1, 3: 2, 4: 4, 5: 8, 11: 4, 12: 8, 13: 4, 16: 8 };
const WIDTH = 256, HEIGHT = 257, BITS = 258, COMPRESSION = 259, STRIP_OFFSETS = 273, ROWS_PER_STRIP = 278, STRIP_BYTES = 279,
  PREDICTOR = 317, TILE_WIDTH = 322, TILE_HEIGHT = 323, TILE_OFFSETS = 324, TILE_BYTES = 325, SAMPLE_FORMAT = 339,
  PIXEL_SCALE = 33550, TIE_POINT = 33922, NO_DATA = 42113;

function readTags(view) {
  const little = view.getUint16(0) === 0x4949, large = view.getUint16(2, little) === 43;
  const word = (at) => (large ? Number(view.getBigUint64(at, little)) : view.getUint32(at, little));
  const directory = word(large ? 8 : 4);
  const count = large ? Number(view.getBigUint64(directory, little)) : view.getUint16(directory, little);
  const tags = new Map(), step = large ? 20 : 12, word_bytes = large ? 8 : 4;
  for (let k = 0; k < count; ++k) {
    const at = directory + (large ? 8 : 2) + k * step;
    const tag = view.getUint16(at, little), type = view.getUint16(at + 2, little), n = word(at + 4);
    const size = SIZES[type] ?? 1, value_at = at + 4 + word_bytes;
    const from = n * size <= word_bytes ? value_at : word(value_at);
    const read = (p) => {
      if (type === 3) return view.getUint16(p, little);
      if (type === 4 || type === 13) return view.getUint32(p, little);
      if (type === 11) return view.getFloat32(p, little);
      if (type === 12) return view.getFloat64(p, little);
      if (type === 16) return Number(view.getBigUint64(p, little));
      return view.getUint8(p);
    };
    tags.set(tag, Array.from({ length: n }, (_, i) => read(from + i * size)));
  }
  return { tags, little };
}

/** Undoes the predictor of a tile's rows in place; floats' bytes come back in the machine's order. */
function unpredict(bytes, predictor, width, height, size) {
  const row_bytes = width * size;
  for (let y = 0; y < height; ++y) {
    const row = bytes.subarray(y * row_bytes, (y + 1) * row_bytes);
    if (predictor === 3) {
      for (let i = 1; i < row.length; ++i) row[i] = row[i] + row[i - 1];
      const planes = row.slice();
      for (let x = 0; x < width; ++x) {
        for (let b = 0; b < size; ++b) row[x * size + size - 1 - b] = planes[b * width + x];
      }
    } else if (predictor === 2 && size === 1) {
      for (let i = 1; i < row.length; ++i) row[i] = row[i] + row[i - 1];
    } else if (predictor !== 1) {
      throw new Error("has a predictor that is not read here");
    }
  }
}

/** { nx, ny, west_m, south_m, cell_m, values }: rows from the south, NaN where there is nothing. */
export async function readTiff(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  const { tags, little } = readTags(view);
  const one = (tag, otherwise) => tags.get(tag)?.[0] ?? otherwise;
  const nx = one(WIDTH), ny = one(HEIGHT), size = one(BITS, 8) / 8, format = one(SAMPLE_FORMAT, 1);
  const packed = one(COMPRESSION, 1) !== 1, predictor = one(PREDICTOR, 1);
  const tiled = tags.has(TILE_OFFSETS);
  const tile_x = tiled ? one(TILE_WIDTH) : nx, tile_y = tiled ? one(TILE_HEIGHT) : one(ROWS_PER_STRIP, ny);
  const offsets = tags.get(tiled ? TILE_OFFSETS : STRIP_OFFSETS), lengths = tags.get(tiled ? TILE_BYTES : STRIP_BYTES);
  const across = Math.ceil(nx / tile_x), values = new Float32Array(nx * ny).fill(NaN);
  const text = (tags.get(NO_DATA) ?? []).map((c) => String.fromCharCode(c)).join("").replace(/\0.*/, "");
  const gap = text === "" ? NaN : Number(text);
  for (let k = 0; k < offsets.length; ++k) {
    if (!lengths[k]) continue;
    const x0 = (k % across) * tile_x, y0 = Math.floor(k / across) * tile_y;
    const rows = tiled ? tile_y : Math.min(tile_y, ny - y0);
    let tile = bytes.slice(offsets[k], offsets[k] + lengths[k]);
    if (packed) tile = await inflate(tile);
    unpredict(tile, predictor, tile_x, rows, size);
    const of = new DataView(tile.buffer, tile.byteOffset, tile.length), order = predictor === 3 ? true : little;
    const read = format === 3 ? (size === 8 ? (p) => of.getFloat64(p, order) : (p) => of.getFloat32(p, order))
      : size === 1 ? (p) => of.getUint8(p) : size === 2 ? (p) => of.getUint16(p, order) : (p) => of.getUint32(p, order);
    for (let y = 0; y < rows && y0 + y < ny; ++y) {
      const to = (ny - 1 - (y0 + y)) * nx;
      for (let x = 0; x < tile_x && x0 + x < nx; ++x) {
        const value = read((y * tile_x + x) * size);
        values[to + x0 + x] = value === gap ? NaN : value;
      }
    }
  }
  const [cell_m, cell_y_m] = tags.get(PIXEL_SCALE), [i, j, , west, north] = tags.get(TIE_POINT);
  return { nx, ny, cell_m, west_m: west - i * cell_m, south_m: north + j * cell_y_m - ny * cell_y_m, values };
}
