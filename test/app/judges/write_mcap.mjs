// Writes an MCAP file with @mcap/core, which nobody of this project wrote.
//
//   node write_mcap.mjs NODE_MODULES FILE chunked|plain
//
// Topic /pose: geometry_msgs/msg/PoseStamped, 50 messages at 10 Hz, position (k, k / 2, -1), a turn about z by acos(0.8) twice.
import { createRequire } from "node:module";
import { open } from "node:fs/promises";
import path from "node:path";

const [modules, file, form] = process.argv.slice(2);
const require = createRequire(path.join(path.resolve(modules), "anchor.js"));
const { McapWriter } = require("@mcap/core");
const { MessageWriter } = require("@foxglove/rosmsg2-serialization");
const { parse } = require("@foxglove/rosmsg");

const rule = "\n" + "=".repeat(80) + "\n";
const text = "std_msgs/Header header\ngeometry_msgs/Pose pose" +
  rule + "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id" +
  rule + "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec" +
  rule + "MSG: geometry_msgs/Pose\nPoint position\nQuaternion orientation" +
  rule + "MSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z" +
  rule + "MSG: geometry_msgs/Quaternion\nfloat64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n";

const handle = await open(file, "w");
let position = 0n;
const writable = {
  async write(bytes) {
    await handle.write(bytes);
    position += BigInt(bytes.length);
  },
  position: () => position,
};
const writer = new McapWriter({ writable, useChunks: form === "chunked", chunkSize: 1000 });
await writer.start({ profile: "ros2", library: "judge" });
const schemaId = await writer.registerSchema({
  name: "geometry_msgs/msg/PoseStamped", encoding: "ros2msg", data: new TextEncoder().encode(text) });
const channelId = await writer.registerChannel({ topic: "/pose", messageEncoding: "cdr", schemaId, metadata: new Map() });
const messages = new MessageWriter(parse(text, { ros2: true }));
for (let k = 0; k < 50; ++k) {
  const time = BigInt(k) * 100000000n;
  const stamp = { sec: Math.floor(k / 10), nanosec: (k % 10) * 100000000 };
  const data = messages.writeMessage({
    header: { stamp, frame_id: "map" },
    pose: { position: { x: k, y: k / 2, z: -1 }, orientation: { x: 0, y: 0, z: 0.6, w: 0.8 } } });
  await writer.addMessage({ channelId, sequence: k, logTime: time, publishTime: time, data });
}
await writer.end();
await handle.close();
