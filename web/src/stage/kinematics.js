// Where the parts of a machine are, from its pose and its joints. The order of bodies is that of SceneAssembly: links, wheels,
// shoes of tracks, rockers and couplers, cylinders, soil in shovels.

import { Matrix4, Quaternion, Vector3 } from "three";

const UNIT = new Vector3(1, 1, 1);

/** [x, y, z, qw, qx, qy, qz] as a matrix. */
export function poseOf(seven) {
  return new Matrix4().compose(new Vector3(seven[0], seven[1], seven[2]), new Quaternion(seven[4], seven[5], seven[6], seven[3]), UNIT);
}

function frame(x, y, z, origin) {
  return new Matrix4().makeBasis(x, y, z).setPosition(origin);
}

/** x along `direction`, y as near to `hint` as can be. */
function frameFromX(direction, hint, origin) {
  const x = direction.clone().normalize(), z = x.clone().cross(hint).normalize();
  return frame(x, z.clone().cross(x), z, origin);
}

function jointMotion(joint, q) {
  const axis = new Vector3(...joint.axis);
  if (joint.type === "turns") return new Matrix4().makeRotationAxis(axis, q);
  if (joint.type === "slides") return new Matrix4().makeTranslation(axis.multiplyScalar(q));
  return new Matrix4();
}

/** Where the circles about a and b meet, on the side that a positive turn about the axis leads to (side 1) or the other. */
function meetingPoint(a, a_radius, b, b_radius, axis, side) {
  const along = b.clone().sub(a), apart = along.length();
  along.divideScalar(apart);
  const foot = 0.5 * (apart + (a_radius * a_radius - b_radius * b_radius) / apart);
  const height = Math.sqrt(Math.max(0, a_radius * a_radius - foot * foot));
  return a.clone().addScaledVector(along, foot).addScaledVector(axis.clone().cross(along), side * height);
}

class Mechanism {
  constructor(machine, q) {
    this.machine = machine;
    this.q = q;
    this.X_PB = machine.joints.map((joint, k) => poseOf(joint.X_PJ).multiply(jointMotion(joint, q[k])));
  }

  axis(joint) {
    const { X_PJ, axis } = this.machine.joints[joint];
    return new Vector3(...axis).transformDirection(poseOf(X_PJ));
  }

  /** Rocker and coupler in the joint's parent link. */
  fourBar(linkage) {
    const axis = this.axis(linkage.joint), pivot = new Vector3(...linkage.rocker_pin_m);
    const pin = new Vector3(...linkage.coupler_pin_m).applyMatrix4(this.X_PB[linkage.joint]);
    const knee = meetingPoint(pivot, linkage.rocker_m, pin, linkage.coupler_m, axis, linkage.branch);
    const bar = (origin) => {
      const x = knee.clone().sub(origin).normalize();
      return frame(x, axis, x.clone().cross(axis), origin);
    };
    return [bar(pivot), bar(pin)];
  }

  pins(cylinder) {
    const joint = this.machine.joints[cylinder.joint];
    const place = (pin, link) => {
      const p = new Vector3(...pin);
      return link === joint.child ? p.applyMatrix4(this.X_PB[cylinder.joint]) : p;
    };
    const barrel = place(cylinder.barrel_pin_m, cylinder.barrel_link);
    if (cylinder.linkage < 0) return [barrel, place(cylinder.rod_pin_m, cylinder.rod_link)];
    const [rocker] = this.fourBar(this.machine.linkages[cylinder.linkage]);
    return [barrel, new Vector3(...cylinder.rod_pin_m).applyMatrix4(rocker)];
  }
}

function arcLengths(path) {
  const arc = [0];
  path.forEach((p, i) => {
    const n = path[(i + 1) % path.length];
    arc.push(arc[i] + Math.hypot(n[0] - p[0], n[1] - p[1], n[2] - p[2]));
  });
  return arc;
}

/** On a closed path: x along it, z across the link's y. */
function onPath(path, arc, s) {
  const total = arc[path.length];
  s -= total * Math.floor(s / total);
  let i = 0;
  while (i + 1 < path.length && arc[i + 1] <= s) ++i;
  const a = new Vector3(...path[i]), b = new Vector3(...path[(i + 1) % path.length]);
  const at = a.clone().lerp(b, (s - arc[i]) / (arc[i + 1] - arc[i]));
  return frameFromX(b.sub(a), new Vector3(0, 1, 0), at);
}

/**
 * Poses in W of all bodies of a machine. `joints` and `gears` map names to positions; a joint that is not known stands where the
 * scenario has it at the start.
 */
export function bodyPoses(machine, X_WB, joints, gears) {
  const q = machine.joints.map((joint) => joints[joint.name] ?? joint.initial);
  const mechanism = new Mechanism(machine, q);
  const links = [X_WB];
  machine.joints.forEach((joint, k) => {
    links[joint.child] = links[joint.parent].clone().multiply(mechanism.X_PB[k]);
  });
  const poses = [...links];
  const angle = (gear) => gears[machine.gears[gear].name] ?? 0;
  for (const wheel of machine.wheels) {
    poses.push(links[machine.gears[wheel.gear].link].clone()
      .multiply(new Matrix4().makeRotationY(angle(wheel.gear)).setPosition(...wheel.axle_m)));
  }
  for (const track of machine.tracks) {
    const gear = machine.gears[track.gear];
    track.arc ??= arcLengths(track.path_m);
    const total = track.arc[track.path_m.length];
    for (let k = 0; k < track.shoes; ++k) {
      const s = gear.radius_m * angle(track.gear) + (total * k) / track.shoes;
      poses.push(links[gear.link].clone().multiply(onPath(track.path_m, track.arc, s)));
    }
  }
  for (const linkage of machine.linkages) {
    const X_WP = links[machine.joints[linkage.joint].parent];
    for (const X_PR of mechanism.fourBar(linkage)) poses.push(X_WP.clone().multiply(X_PR));
  }
  for (const cylinder of machine.cylinders) {
    const X_WP = links[machine.joints[cylinder.joint].parent], axis = mechanism.axis(cylinder.joint);
    const [barrel, rod] = mechanism.pins(cylinder);
    const hint = new Vector3(0, 1, 0).transformDirection(links[cylinder.barrel_link]);
    const along = rod.clone().sub(barrel).transformDirection(X_WP);
    for (let k = 0; k < cylinder.count; ++k) {
      const aside = axis.clone().multiplyScalar((k - 0.5 * (cylinder.count - 1)) * cylinder.spacing_m);
      for (const pin of [barrel, rod]) poses.push(frameFromX(along, hint, pin.clone().add(aside).applyMatrix4(X_WP)));
    }
  }
  for (const link of machine.loads) poses.push(links[link].clone());
  return { poses, links };
}
