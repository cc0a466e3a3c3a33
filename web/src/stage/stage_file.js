// What `tera view` says of a scene's machines and things: a header in JSON, and numbers behind it that it points to.

const MAGIC = "TSTG";

/** The header, each part of a mesh with its arrays in place of their offsets. */
export function unpackStage(buffer) {
  const view = new DataView(buffer), text = new TextDecoder();
  if (text.decode(new Uint8Array(buffer, 0, 4)) !== MAGIC) throw new Error("the scene's file is of another form");
  const length = view.getUint32(4, true), stage = JSON.parse(text.decode(new Uint8Array(buffer, 8, length)));
  const base = 8 + length;
  for (const mesh of stage.meshes) {
    for (const part of mesh.parts) {
      for (const [name, type] of [["positions", Float32Array], ["normals", Float32Array], ["colours", Float32Array], ["indices", Uint32Array]]) {
        if (part[name]) part[name] = new type(buffer, base + part[name][0], part[name][1]);
      }
    }
  }
  return stage;
}
