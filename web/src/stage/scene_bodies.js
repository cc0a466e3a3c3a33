// Machines and things of a stage as objects of the 3-D view: one instanced mesh for each part of a mesh, an instance for each node.

import * as THREE from "three";
import { poseOf } from "./kinematics.js";

export class SceneBodies {
  /** `tint` of a dataset that stands beside another: drawn as a transparent shape of that colour. */
  constructor(stage, tint = null) {
    this.stage = stage;
    this.object = new THREE.Group();
    this.X_WB = Array.from({ length: stage.bodies }, () => new THREE.Matrix4());
    this.hidden = new Set();
    const by_mesh = new Map();
    for (const node of stage.nodes) {
      if (!by_mesh.has(node.mesh)) by_mesh.set(node.mesh, []);
      const X_BG = poseOf(node.X_BG).scale(new THREE.Vector3(node.scale, node.scale, node.scale));
      by_mesh.get(node.mesh).push({ ...node, X_BG });
    }
    this.groups = [...by_mesh].map(([mesh, nodes]) => ({
      nodes,
      parts: stage.meshes[mesh].parts.map((part) => this.#part(part, nodes.length, tint)),
    }));
    stage.obstacles.forEach((obstacle) => {
      obstacle.track = obstacle.poses.map(([t_s, seven]) => [t_s, poseOf(seven)]);
    });
  }

  #part(part, count, tint) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(part.positions, 3));
    geometry.setAttribute("normal", new THREE.BufferAttribute(part.normals, 3));
    if (part.colours) geometry.setAttribute("color", new THREE.BufferAttribute(part.colours, 3));
    geometry.setIndex(new THREE.BufferAttribute(part.indices, 1));
    const colour = tint ? new THREE.Color(tint) : new THREE.Color().setRGB(...part.colour, THREE.LinearSRGBColorSpace);
    const opacity = tint ? 0.45 : part.opacity;
    const material = new THREE.MeshLambertMaterial({
      color: part.colours && !tint ? 0xffffff : colour, vertexColors: Boolean(part.colours) && !tint,
      transparent: opacity < 1, opacity, depthWrite: opacity === 1, side: THREE.DoubleSide,
    });
    const mesh = new THREE.InstancedMesh(geometry, material, count);
    mesh.frustumCulled = false;
    this.object.add(mesh);
    return mesh;
  }

  /** Machines as Dataset.stateAt gives them, obstacles by their tracks. */
  place(state, t_s) {
    for (const machine of this.stage.machines) {
      state[machine.name]?.poses?.forEach((X_WB, k) => this.X_WB[machine.first_body + k].copy(X_WB));
    }
    for (const obstacle of this.stage.obstacles) this.X_WB[obstacle.body].copy(trackAt(obstacle.track, t_s));
    const X_WG = new THREE.Matrix4();
    for (const { nodes, parts } of this.groups) {
      nodes.forEach((node, k) => {
        X_WG.multiplyMatrices(this.X_WB[node.body], node.X_BG);
        for (const part of parts) part.setMatrixAt(k, X_WG);
      });
      for (const part of parts) part.instanceMatrix.needsUpdate = true;
    }
  }
}

function trackAt(track, t_s) {
  let k = 0;
  while (k + 1 < track.length && track[k + 1][0] <= t_s) ++k;
  if (k + 1 === track.length) return track[k][1];
  const s = Math.max(0, (t_s - track[k][0]) / (track[k + 1][0] - track[k][0]));
  const parts = (X) => {
    const p = new THREE.Vector3(), q = new THREE.Quaternion(), scale = new THREE.Vector3();
    X.decompose(p, q, scale);
    return { p, q };
  };
  const a = parts(track[k][1]), b = parts(track[k + 1][1]);
  return new THREE.Matrix4().compose(a.p.lerp(b.p, s), a.q.slerp(b.q, s), new THREE.Vector3(1, 1, 1));
}
