// Expands a JSON-LD document by the library jsonld, which fails where a term is not defined. Relative @ids are of the
// document's own url.
//
//   node check_jsonld.mjs NODE_MODULES FILE
//
// NODE_MODULES is a folder with the npm package jsonld. Prints the kinds of nodes and how many there are, as JSON.
import { createRequire } from "node:module";
import { readFile } from "node:fs/promises";
import path from "node:path";

const [modules, file] = process.argv.slice(2);
const jsonld = createRequire(path.join(path.resolve(modules), "anchor.js"))("jsonld");
const document = JSON.parse(await readFile(file, "utf8"));
const [dataset] = await jsonld.expand(document, { safe: true, base: document.url + "/" });
const kinds = {};
const visit = (node) => {
  if (Array.isArray(node)) return node.forEach(visit);
  if (node === null || typeof node !== "object") return;
  for (const kind of node["@type"] && !node["@value"] ? [node["@type"]].flat() : []) kinds[kind] = (kinds[kind] ?? 0) + 1;
  Object.values(node).forEach(visit);
};
visit(dataset);
console.log(JSON.stringify({ kinds, conformsTo: dataset["http://purl.org/dc/terms/conformsTo"] }));
