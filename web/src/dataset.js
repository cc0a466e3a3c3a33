// One dataset as the page sees it: its channels, its machines' motion, its sensors' places.

import { Matrix4, Quaternion, Vector3 } from "three";
import { Lens } from "./stage/lens.js";
import { bodyPoses, poseOf } from "./stage/kinematics.js";
import { unpackStage } from "./stage/stage_file.js";

/** The camera's optical frame in its sensor frame: x right, y down, z forward of x forward, y left, z up. */
const X_SC = new Matrix4().set(0, 0, 1, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, 1);

const UNITS = [["mps2", "m/s²"], ["radps", "rad/s"], ["mps", "m/s"], ["rad", "rad"], ["deg", "°"], ["kg", "kg"], ["m3", "m³"], ["pa", "Pa"],
  ["nm", "N m"], ["m2", "m²"], ["m", "m"], ["n", "N"], ["s", "s"], ["hz", "Hz"]];

/** [name, unit] of a column: "wx_radps" is ["wx", "rad/s"]. */
export function nameAndUnit(column, path) {
  for (const [ending, unit] of UNITS) {
    if (column.endsWith(`_${ending}`)) return [column.slice(0, -ending.length - 1), unit];
  }
  if (path.endsWith("commands.csv")) return [column, "lever"];
  return [column, ""];
}

function interpolated(found, t_s) {
  const { now, next } = found;
  if (!next || next.t_ns <= now.t_ns) return now.values;
  const s = Math.min(1, Math.max(0, (t_s * 1e9 - now.t_ns) / (next.t_ns - now.t_ns)));
  return now.values.map((value, k) => value + s * (next.values[k] - value));
}

function poseBetween(found, t_s) {
  const { now, next } = found;
  const quaternion = (v) => new Quaternion(v[4], v[5], v[6], v[3]);
  const values = interpolated(found, t_s), turn = quaternion(now.values);
  if (next) turn.slerp(quaternion(next.values), Math.min(1, Math.max(0, (t_s * 1e9 - now.t_ns) / (next.t_ns - now.t_ns))));
  return new Matrix4().compose(new Vector3(...values.slice(0, 3)), turn.normalize(), new Vector3(1, 1, 1));
}

export class Dataset {
  constructor(source, letter, index, calls) {
    this.source = source;
    this.letter = letter;
    this.index = index;
    this.calls = calls;
    this.stage = null;
    this.channels = index.channels;
    this.by_path = new Map(index.channels.map((channel) => [channel.path, channel]));
    this.frame_lists = new Map();
    this.states = new Map();
  }

  get cameras() {
    return this.channels.filter((channel) => channel.form === "pictures");
  }
  get lidars() {
    return this.channels.filter((channel) => channel.form === "scans");
  }
  get tables() {
    return this.channels.filter((channel) => channel.form === "rows");
  }
  /** What drives or measures; things that move have no channels of their own beside their truth. */
  get machines() {
    return this.index.machines.filter((name) => this.channels.some((channel) => channel.path.startsWith(`${name}/`)));
  }

  call(method, args) {
    return this.calls.call(method, { source: this.source, ...args });
  }

  /** Times and names of frames; asked for once. */
  frames(channel) {
    if (!this.frame_lists.has(channel.path)) this.frame_lists.set(channel.path, this.call("frames", { path: channel.file }));
    return this.frame_lists.get(channel.path);
  }

  async loadStage(url) {
    const answer = await fetch(url);
    if (!answer.ok) {
      this.stage_error = (await answer.text()) || `status ${answer.status}`;
      return;
    }
    this.stage = unpackStage(await answer.arrayBuffer());
    this.states.clear();
  }

  /** Tables that say how a machine moves: its pose, and its joints, of truth or else of encoders. */
  #motionTables(machine) {
    const pose = this.channels.find((c) => c.type === "pose" && c.path.split("/").at(-2) === machine && c.path.endsWith("pose.csv"));
    const joints = this.by_path.get(`truth/${machine}/joints.csv`);
    const encoders = this.channels.filter((c) => c.type === "encoder" && c.path.startsWith(`${machine}/`));
    return { pose, joints: joints ? [joints] : encoders };
  }

  /** Each machine at a time: { name: { X_WB, joints, poses, links } }; kept for the last few times asked. */
  stateAt(t_s) {
    if (!this.states.has(t_s)) {
      if (this.states.size > 64) this.states.delete(this.states.keys().next().value);
      this.states.set(t_s, this.#state(t_s));
    }
    return this.states.get(t_s);
  }

  async #state(t_s) {
    const state = {};
    await Promise.all(this.machines.map(async (name) => {
      const { pose, joints } = this.#motionTables(name);
      const tables = [...(pose ? [pose] : []), ...joints];
      const rows = await this.call("rows", { paths: tables.map((c) => c.file), t_s });
      const place = pose ? rows.shift() : null;
      const positions = {};
      for (const found of rows.filter(Boolean)) {
        const values = interpolated(found, t_s);
        found.columns.forEach((column, k) => {
          const [joint, unit] = nameAndUnit(column, "");
          if (unit === "rad" || unit === "m") positions[joint] = values[k];
        });
      }
      const X_WB = place ? poseBetween(place, t_s) : new Matrix4();
      const machine = this.stage?.machines.find((one) => one.name === name);
      state[name] = { X_WB, joints: positions, has_pose: place !== null, ...(machine ? bodyPoses(machine, X_WB, positions, positions) : {}) };
    }));
    return state;
  }

  /** X_WS of a sensor, or null where it is not known. */
  async sensorPose(channel, t_s) {
    const machine = channel.path.split("/")[0], sheet = channel.sheet;
    const now = (await this.stateAt(t_s))[machine];
    if (!now || !sheet?.X_PS) return null;
    const stage = this.stage?.machines.find((one) => one.name === machine);
    const link = stage ? stage.links.indexOf(sheet.parent_link) : -1;
    const X_WP = link >= 0 ? now.links[link] : sheet.parent_link && stage ? null : now.X_WB;
    return X_WP && X_WP.clone().multiply(poseOf(sheet.X_PS));
  }

  async opticalPose(channel, t_s) {
    const X_WS = await this.sensorPose(channel, t_s);
    return X_WS && X_WS.multiply(X_SC);
  }

  lens(channel) {
    return channel.sheet?.lens ? new Lens(channel.sheet.lens) : null;
  }

  instanceName(id) {
    return this.index.instances.find((one) => one.id === id)?.name ?? (id ? `instance ${id}` : "");
  }
  className(id) {
    return this.index.classes[id]?.name ?? "";
  }
}
