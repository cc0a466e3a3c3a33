// Where the bytes of files come from: the program's server, by ranges, or the page itself where it was exported.

/** Files below /data/ of the server that sent the page. */
export class ServedFiles {
  constructor(base) {
    this.base = base;
  }

  /** Bytes [begin, end) of a file; fewer where it ends before. */
  async read(path, begin = 0, end = Infinity) {
    const headers = begin === 0 && end === Infinity ? {} : { Range: `bytes=${begin}-${end === Infinity ? "" : end - 1}` };
    const answer = await fetch(this.base + path.split("/").map(encodeURIComponent).join("/"), { headers });
    if (answer.status === 416) return new Uint8Array(0);
    if (!answer.ok) throw new Error(`${path}: ${answer.status === 404 ? "is not there" : `status ${answer.status}`}`);
    return new Uint8Array(await answer.arrayBuffer());
  }
}

/** Files that were packed into the page: `places` maps a path to [begin, length] in `bytes`; `base` tells datasets apart. */
export class PackedFiles {
  constructor(places, bytes, base) {
    this.places = places;
    this.bytes = bytes;
    this.base = base;
  }

  async read(path, begin = 0, end = Infinity) {
    const place = this.places[path];
    if (!place) throw new Error(`${path}: is not part of this excerpt`);
    return this.bytes.slice(place[0] + begin, place[0] + Math.min(end, place[1]));
  }
}
