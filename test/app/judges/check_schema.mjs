// Holds JSON files against a JSON schema by ajv.
//
//   node check_schema.mjs NODE_MODULES SCHEMA FILE...
//
// NODE_MODULES is a folder with the npm package ajv. Prints the first fault and ends with status 1.
import { createRequire } from "node:module";
import { readFile } from "node:fs/promises";
import path from "node:path";

const [modules, schema, ...files] = process.argv.slice(2);
const require = createRequire(path.join(path.resolve(modules), "anchor.js"));
const { default: Ajv } = require("ajv");
const validate = new Ajv({ strict: false }).compile(JSON.parse(await readFile(schema, "utf8")));
for (const file of files) {
  if (validate(JSON.parse(await readFile(file, "utf8")))) continue;
  console.error(`${file}: ${JSON.stringify(validate.errors[0])}`);
  process.exit(1);
}
console.log(`${files.length} files are as ${path.basename(schema)} says`);
