// PNGs of labels: a canvas would take away their 16 bits.

import { inflate } from "./inflate.js";

const SAMPLES = { 0: 1, 2: 3 };

/** One row back from its filter, in place behind the row above it; `above` is null for the first. */
function unfilterRow(filter, row, above, pixel_bytes) {
  const n = row.length;
  if (filter === 0) return;
  if (filter === 1) {
    for (let i = pixel_bytes; i < n; ++i) row[i] += row[i - pixel_bytes];
    return;
  }
  if (filter === 2) {
    if (above) for (let i = 0; i < n; ++i) row[i] += above[i];
    return;
  }
  for (let i = 0; i < n; ++i) {
    const left = i >= pixel_bytes ? row[i - pixel_bytes] : 0, up = above ? above[i] : 0;
    if (filter === 3) {
      row[i] += (left + up) >> 1;
    } else {
      const corner = i >= pixel_bytes && above ? above[i - pixel_bytes] : 0;
      const p = left + up - corner, a = Math.abs(p - left), b = Math.abs(p - up), c = Math.abs(p - corner);
      row[i] += a <= b && a <= c ? left : b <= c ? up : corner;
    }
  }
}

function unfilter(raw, width, height, pixel_bytes) {
  const stride = width * pixel_bytes, out = new Uint8Array(stride * height);
  let above = null;
  for (let y = 0; y < height; ++y) {
    const from = y * (stride + 1), row = out.subarray(y * stride, (y + 1) * stride);
    row.set(raw.subarray(from + 1, from + 1 + stride));
    unfilterRow(raw[from], row, above, pixel_bytes);
    above = row;
  }
  return out;
}

/** { width, height, samples, values }: grey or RGB, of 8 or 16 bits. */
export async function readPng(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  if (bytes.length < 33 || view.getUint32(0) !== 0x89504e47) throw new Error("is no PNG");
  const width = view.getUint32(16), height = view.getUint32(20), bits = bytes[24], samples = SAMPLES[bytes[25]];
  if (!samples || (bits !== 8 && bits !== 16)) throw new Error("is a PNG of another form than labels have");
  const parts = [];
  for (let at = 8; at + 12 <= bytes.length;) {
    const length = view.getUint32(at), kind = view.getUint32(at + 4);
    if (kind === 0x49444154) parts.push(bytes.subarray(at + 8, at + 8 + length));
    at += 12 + length;
  }
  const packed = new Uint8Array(parts.reduce((sum, p) => sum + p.length, 0));
  parts.reduce((at, p) => (packed.set(p, at), at + p.length), 0);
  const raw = unfilter(await inflate(packed), width, height, (samples * bits) / 8);
  if (bits === 8) return { width, height, samples, values: raw };
  const values = new Uint16Array(width * height * samples);
  for (let k = 0; k < values.length; ++k) values[k] = (raw[2 * k] << 8) | raw[2 * k + 1];
  return { width, height, samples, values };
}
