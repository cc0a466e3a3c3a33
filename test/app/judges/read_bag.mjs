// Reads a bag of ROS with programs that nobody of this project wrote, and prints as JSON what it
// holds: of each topic its type, how many messages, the first two and the last one, with their times.
//
//   node read_bag.mjs NODE_MODULES FILE.mcap|FILE.db3|FILE.bag
//
// NODE_MODULES is a folder with @mcap/core, @mcap/support, @mcap/nodejs, @foxglove/rosmsg,
// @foxglove/rosmsg2-serialization, @foxglove/rosbag2 and sql.js, @foxglove/rosbag.
import { createRequire } from "node:module";
import { open, readFile } from "node:fs/promises";
import path from "node:path";

const [modules, file] = process.argv.slice(2);
const require = createRequire(path.join(path.resolve(modules), "anchor.js"));
const { parse } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");

// Many numbers are told by how many there are, their sum, the first and the last: pictures, clouds and maps are large.
const shown = (key, value) => {
  if (typeof value === "bigint") return value.toString();
  if (ArrayBuffer.isView(value) && value.length > 64) {
    let sum = 0;
    for (const byte of value) sum += Number(byte);
    return { length: value.length, sum, first: value[0], last: value[value.length - 1] };
  }
  if (ArrayBuffer.isView(value)) return Array.from(value, (v) => (Number.isFinite(v) ? v : String(v)));
  if (typeof value === "number" && !Number.isFinite(value)) return String(value);
  return value;
};

const topics = {};
function take(topic, type, time, message) {
  const entry = (topics[topic] ??= { type, count: 0, first: { time, message } });
  entry.count += 1;
  if (entry.count === 2) entry.second = { time, message };
  entry.last = { time, message };
}

async function readMcap() {
  const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
  const { loadDecompressHandlers } = require("@mcap/support");
  const { FileHandleReadable } = require("@mcap/nodejs");
  const decompressHandlers = await loadDecompressHandlers();
  const handle = await open(file);
  const reader = await McapIndexedReader.Initialize({
    readable: new FileHandleReadable(handle),
    decompressHandlers,
  });
  const decoders = new Map();
  let before = 0n;
  for await (const record of reader.readMessages({ validateCrcs: true })) {
    const channel = reader.channelsById.get(record.channelId);
    const schema = reader.schemasById.get(channel.schemaId);
    if (!decoders.has(schema.id)) {
      const text = new TextDecoder().decode(schema.data);
      decoders.set(schema.id, new MessageReader(parse(text, { ros2: true })));
    }
    if (record.logTime < before) throw new Error(`time goes back at ${record.logTime}`);
    before = record.logTime;
    const message = decoders.get(schema.id).readMessage(record.data);
    take(channel.topic, schema.name, record.logTime, message);
  }
  // Once more as a stream, from the first byte to the last, with all checksums.
  const stream = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  stream.append(await readFile(file));
  let streamed = 0n;
  for (let record; (record = stream.nextRecord()); ) {
    if (record.type === "Message") streamed += 1n;
  }
  if (!stream.done()) throw new Error("the stream does not end where the file does");
  const counted = reader.statistics.messageCount;
  if (counted !== streamed) throw new Error(`statistics say ${counted}, the stream ${streamed}`);
  for (const [id, count] of reader.statistics.channelMessageCounts) {
    const told = topics[reader.channelsById.get(id).topic]?.count ?? 0;
    if (BigInt(told) !== count) throw new Error(`channel ${id}: index ${told}, statistics ${count}`);
  }
  await handle.close();
  return {
    profile: reader.header.profile,
    chunks: reader.chunkIndexes.length,
    compression: reader.chunkIndexes[0]?.compression,
    channels: [...reader.channelsById.values()].map((c) => ({
      topic: c.topic,
      encoding: c.messageEncoding,
      qos: c.metadata.get("offered_qos_profiles"),
    })),
  };
}

const stampOf = (nanoseconds) => ({
  sec: Number(nanoseconds / 1000000000n),
  nsec: Number(nanoseconds % 1000000000n),
});

// The database as @foxglove/rosbag2 asks for it, by SQLite in WebAssembly.
function databaseOf(database, parseQosProfiles) {
  const rows = function* (sql) {
    const statement = database.prepare(sql);
    while (statement.step()) yield statement.get(null, { useBigInt: true });
    statement.free();
  };
  const topics = () => {
    const found = new Map();
    for (const [id, name, type, serializationFormat, qos] of rows("SELECT * FROM topics")) {
      found.set(id, { name, type, serializationFormat, offeredQosProfiles: parseQosProfiles(qos) });
    }
    return found;
  };
  return {
    open: async () => {},
    close: async () => database.close(),
    readTopics: async () => [...topics().values()],
    readMessages: async function* (options) {
      const byId = topics();
      const sql = "SELECT topic_id, timestamp, data FROM messages ORDER BY timestamp, id";
      for (const [id, time, data] of rows(sql)) {
        const topic = byId.get(id);
        if (options.topics.includes(topic.name)) yield { topic, timestamp: stampOf(time), data };
      }
    },
    timeRange: async () => {
      const [[min, max]] = [...rows("SELECT MIN(timestamp), MAX(timestamp) FROM messages")];
      return [stampOf(min), stampOf(max)];
    },
    messageCounts: async () => new Map(),
  };
}

async function readSqlite() {
  const { Rosbag2, parseQosProfiles } = require("@foxglove/rosbag2");
  const SQL = await require("sql.js")();
  const database = new SQL.Database(await readFile(file));
  const rows = databaseOf(database, parseQosProfiles);
  const bag = new Rosbag2([rows]);
  await bag.open();
  const channels = (await bag.readTopics()).map((topic) => ({
    topic: topic.name,
    encoding: topic.serializationFormat,
    qos: topic.offeredQosProfiles,
  }));
  // By ROS's own definitions: the bag carries none. Grid maps and levers are of packages beside ROS, and counted alone.
  const isBeside = ({ type }) => type.startsWith("grid_map_msgs/") || type.startsWith("tera_msgs/");
  const all = await bag.readTopics();
  const names = all.filter((topic) => !isBeside(topic)).map((topic) => topic.name);
  const counted = all.filter(isBeside).map((topic) => topic.name);
  const nanoseconds = ({ sec, nsec }) => BigInt(sec) * 1000000000n + BigInt(nsec);
  for await (const { topic, timestamp } of rows.readMessages({ topics: counted })) {
    take(topic.name, topic.type, nanoseconds(timestamp), null);
  }
  for await (const { topic, timestamp, value } of bag.readMessages({ topics: names })) {
    take(topic.name, topic.type, nanoseconds(timestamp), value);
  }
  await bag.close();
  return { channels };
}

async function readRos1() {
  const { Bag } = require("@foxglove/rosbag");
  const { FileReader } = require("@foxglove/rosbag/node");
  const bag = new Bag(new FileReader(file));
  await bag.open();
  for await (const { topic, connectionId, timestamp, message } of bag.messageIterator()) {
    const time = BigInt(timestamp.sec) * 1000000000n + BigInt(timestamp.nsec);
    take(topic, bag.connections.get(connectionId).type, time, message);
  }
  const channels = [...bag.connections.values()].map(({ topic, md5sum }) => ({ topic, md5sum }));
  return { channels, chunks: bag.chunkInfos.length };
}

const readers = { ".mcap": readMcap, ".db3": readSqlite, ".bag": readRos1 };
const told = await readers[path.extname(file)]();
console.log(JSON.stringify({ ...told, topics }, shown, 1));
