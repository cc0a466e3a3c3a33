// Scans: PCD 0.7, `binary_compressed`, little-endian, as docs/reference/dataset.md says.

/** LibLZF's format: literal runs, and references back of at most 8 KB. */
export function unpackLzf(packed, length) {
  const out = new Uint8Array(length);
  let i = 0, o = 0;
  while (i < packed.length) {
    const control = packed[i++];
    if (control < 32) {
      const run = control + 1;
      if (o + run > length || i + run > packed.length) throw new Error("its points are damaged");
      for (let k = 0; k < run; ++k) out[o++] = packed[i++];
      continue;
    }
    let run = control >> 5;
    if (run === 7) run += packed[i++];
    run += 2;
    let from = o - ((control & 31) << 8) - packed[i++] - 1;
    if (from < 0 || o + run > length) throw new Error("its points are damaged");
    for (let k = 0; k < run; ++k) out[o++] = out[from++];
  }
  if (o !== length) throw new Error("its points are cut off");
  return out;
}

const READERS = {
  F4: (view, at) => view.getFloat32(at, true),
  F8: (view, at) => view.getFloat64(at, true),
  U1: (view, at) => view.getUint8(at),
  U2: (view, at) => view.getUint16(at, true),
  U4: (view, at) => view.getUint32(at, true),
  I1: (view, at) => view.getInt8(at),
  I2: (view, at) => view.getInt16(at, true),
  I4: (view, at) => view.getInt32(at, true),
};

/** { count, x, y, z, intensity, time, ring, instance, label }: an array each, of what the file has. */
export function readPcd(bytes) {
  const marker = "DATA binary_compressed\n";
  const head = new TextDecoder("latin1").decode(bytes.subarray(0, 2048));
  const at = head.indexOf(marker);
  if (at < 0) throw new Error("is no PCD of the form binary_compressed");
  const line = (name) => (head.match(new RegExp(`^${name} (.*)$`, "m"))?.[1] ?? "").trim().split(/\s+/);
  const fields = line("FIELDS"), sizes = line("SIZE").map(Number), types = line("TYPE");
  const count = Number(line("POINTS")[0]);
  const view = new DataView(bytes.buffer, bytes.byteOffset + at + marker.length);
  const packed = view.getUint32(0, true), length = view.getUint32(4, true);
  const begin = at + marker.length + 8;
  const body = unpackLzf(bytes.subarray(begin, begin + packed), length);
  const scan = { count };
  let offset = 0;
  fields.forEach((field, f) => {
    const size = sizes[f], read = READERS[types[f] + size];
    const values = new (size === 4 && types[f] === "F" ? Float32Array : size === 1 ? Uint8Array : size === 2 ? Uint16Array : Uint32Array)(count);
    if (offset % size === 0 && values.BYTES_PER_ELEMENT === size) {
      new Uint8Array(values.buffer).set(body.subarray(offset, offset + size * count));
    } else {
      const of = new DataView(body.buffer, offset);
      for (let k = 0; k < count; ++k) values[k] = read(of, size * k);
    }
    scan[field] = values;
    offset += size * count;
  });
  return scan;
}
