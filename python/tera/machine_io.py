"""One machine's actions as messages, and what is told of it as arrays."""

import math
from dataclasses import dataclass

import numpy as np

from tera.spaces import Box, Dict
from tera.truth import of_state
from tera.v1 import simulation_pb2 as messages

CONTROLS = ("levers", "joint_rates", "joint_positions", "tool_position")


@dataclass(frozen=True)
class Patch:
    """A square of ground heights, `size_m` wide, around the machine or around the cutting edge of `shovel`."""

    size_m: float
    resolution_m: float
    shovel: str = ""


class MachineIo:
    """Spaces, actions and observations of one machine of an environment, by the options of tera.Env."""

    def __init__(self, description, machine=None, control="levers", step_s=0.1, sensors=(), all_frames=False,
                 patch=None, tool_frame=None):
        if control not in CONTROLS:
            raise ValueError(f"control {control!r}; need one of {', '.join(CONTROLS)}")
        if not 0 < step_s < math.inf:
            raise ValueError(f"step_s {step_s}; need a time in seconds, more than 0")
        self.step_s = step_s
        self._control, self._patch = control, patch
        self._choose(description, machine, sensors, tool_frame)
        self.observe = messages.Observe(
            sensors=[messages.SensorSelection(machine=self.machine.name, sensor=name, latest_only=not all_frames)
                     for name in self._sensors])
        if patch:
            self.observe.patches.add(machine=self.machine.name, shovel=patch.shovel, size_m=patch.size_m,
                                     resolution_m=patch.resolution_m)
        self.action_space = self._action_space()
        self.observation_space = self._observation_space()
        self.begin()

    def _choose(self, description, machine, sensors, tool_frame):
        drivable = [m for m in description.machines if m.levers and machine in (None, m.name)]
        if not drivable:
            names = ", ".join(m.name for m in description.machines if m.levers) or "none there"
            raise ValueError(f"no machine {machine!r} with levers; need one of: {names}")
        self.machine = drivable[0]
        known = {s.name: s for s in self.machine.sensors}
        for name in sensors:
            if name not in known:
                raise ValueError(f"no sensor {name!r} on {self.machine.name}; need one of: {', '.join(known)}")
        self._sensors = {name: known[name] for name in sensors}
        frames = [frame.name for frame in self.machine.frames]
        if tool_frame not in [None, *frames] or (self._control == "tool_position" and not frames):
            raise ValueError(f"no frame {tool_frame!r} on {self.machine.name}; need one of: "
                             f"{', '.join(frames) or 'none there'}")
        self._tool_frame = tool_frame or (frames[0] if frames else None)
        self._duration_s = description.duration_s

    def begin(self):
        """Forgets what an earlier episode has measured."""
        self._latest, self._truth = {}, None

    def redescribe(self, description):
        """Takes the machine as an episode has drawn it. Raises ValueError where its spaces are other ones then."""
        before = self.action_space.shape, {name: self.observation_space[name].shape for name in self.observation_space}
        self._choose(description, self.machine.name, self._sensors, self._tool_frame)
        action, observation = self._action_space(), self._observation_space()
        now = action.shape, {name: observation[name].shape for name in observation}
        if now != before:
            raise ValueError(f"the draw gives machine {self.machine.name!r} other levers, joints or sensors; need draws "
                             "that leave its spaces as they are, or a Session")
        self.action_space, self.observation_space = action, observation

    # ---- Actions

    def _action_space(self):
        if self._control == "tool_position":
            return Box(-np.inf, np.inf, (3,), np.float64)
        joints = {j.name: j for j in self.machine.joints}
        gears = {g.name: g for g in self.machine.gears}
        bounds = []
        for lever in self.machine.levers:
            joint, gear = joints.get(lever.joint), gears.get(lever.gear)
            if self._control == "levers":
                bounds.append((-1.0, 1.0))
            elif self._control == "joint_rates":
                bounds.append((-joint.max_rate_negative, joint.max_rate_positive) if joint
                              else (-gear.max_rate_radps, gear.max_rate_radps))
            elif joint is None:
                bounds.append((0.0, 0.0))  # a gear stands
            else:
                free = joint.type == messages.Joint.CONTINUOUS
                bounds.append((-np.inf, np.inf) if free else (joint.lower, joint.upper))
        low, high = np.array(bounds).T
        return Box(low, high, dtype=np.float64)

    def action(self, action):
        values = np.asarray(action, dtype=np.float64)
        space = self.action_space
        if values.shape != space.shape:
            raise ValueError(f"action of shape {values.shape}, need {space.shape}")
        # Single precision may overstep a bound by a rounding; more than that is for the server to refuse.
        rounded = np.clip(values, space.low, space.high)
        values = np.where(np.abs(values - rounded) < 1e-6, rounded, values).tolist()
        message = messages.Action(machine=self.machine.name)
        if self._control == "levers":
            message.levers.position.extend(values)
        elif self._control == "joint_rates":
            message.joint_rates.rate.extend(values)
        elif self._control == "joint_positions":
            message.joint_positions.position.extend(values)
        else:
            message.tool_pose.frame = self._tool_frame
            x, y, z = values
            message.tool_pose.position_B_m.CopyFrom(messages.Vector3(x=x, y=y, z=z))
        return message

    # ---- Observations

    def _observation_space(self):
        def free(*shape):
            return Box(-np.inf, np.inf, shape, np.float64)

        machine = self.machine
        joints, gears = len(machine.joints), len(machine.gears)
        spaces = {"joint_position": free(joints), "joint_rate": free(joints), "joint_effort": free(joints),
                  "gear_rate_radps": free(gears), "levers": Box(-1.0, 1.0, (len(machine.levers),), np.float64),
                  "base_position_W_m": free(3), "base_rotation_WB": free(4), "base_twist": free(6),
                  "shovel_load_kg": free(len(machine.shovels))}
        if self._tool_frame:
            spaces.update({"tool_position_B_m": free(3), "tool_rotation_B": free(4)})
        if machine.cylinders:
            count = len(machine.cylinders)
            spaces.update({"cylinder_stroke_m": free(count), "cylinder_pressure_pa": free(count, 2)})
        if self._patch:
            n = math.floor(self._patch.size_m / self._patch.resolution_m + 0.5) + 1
            spaces["terrain_m"] = Box(-np.inf, np.inf, (n, n), np.float32)
        for sensor in self._sensors.values():
            spaces.update(_sensor_spaces(sensor))
        return Dict(spaces)

    def told(self, told, seed):
        """The observation, info and whether the scenario's duration is over, of a server's Observation."""
        state = next(m for m in told.machines if m.name == self.machine.name)
        v, w = state.v_WB_mps, state.w_WB_B_radps
        observation = {
            "joint_position": np.array(state.joint_position), "joint_rate": np.array(state.joint_rate),
            "joint_effort": np.array(state.joint_effort), "gear_rate_radps": np.array(state.gear_rate_radps),
            "levers": np.array(state.lever),
            "base_position_W_m": _vector(state.X_WB.position_m), "base_rotation_WB": _quaternion(state.X_WB.rotation),
            "base_twist": np.array([v.x, v.y, v.z, w.x, w.y, w.z]),
            "shovel_load_kg": np.array(state.shovel_load_kg)}
        if self._tool_frame:
            tool = next(X for X, frame in zip(state.X_BF, self.machine.frames) if frame.name == self._tool_frame)
            observation["tool_position_B_m"] = _vector(tool.position_m)
            observation["tool_rotation_B"] = _quaternion(tool.rotation)
        if state.cylinder:
            observation["cylinder_stroke_m"] = np.array([c.stroke_m for c in state.cylinder])
            observation["cylinder_pressure_pa"] = np.array([(c.head_pressure_pa, c.rod_pressure_pa)
                                                            for c in state.cylinder])
        if told.patches:
            patch = told.patches[0]
            observation["terrain_m"] = np.frombuffer(patch.height_m, "<f4").reshape(patch.n, patch.n)
        samples = {s.sensor: decode(s) for s in told.samples}
        for name, measured in samples.items():
            if measured:
                self._latest[name] = measured[-1]
        for sensor in self._sensors.values():
            observation.update(_latest_arrays(sensor, self._latest.get(sensor.name)))
        age_s = {name: (told.time_ns - self._latest[name]["time_ns"]) / 1e9 if name in self._latest else None
                 for name in self._sensors}
        self._truth = of_state(state, told.time_ns / 1e9, self._truth)
        info = {"time_s": told.time_ns / 1e9, "seed": seed, "age_s": age_s, "truth": self._truth, "samples": samples,
                "message": told}
        return observation, info, told.time_ns >= round(1e9 * self._duration_s)


# ---- Samples as arrays

_PICTURES = {"rgb": np.dtype("u1"), "depth_m": np.dtype("<f4")}
_LABEL_FIELDS = [field.name for field in messages.CameraFrame.DESCRIPTOR.fields
                 if field.type == field.TYPE_BYTES and field.name not in _PICTURES]
_COLUMNS = {"xyz_S_m": np.dtype("<f4"), "intensity": np.dtype("<f4"), "time_offset_ns": np.dtype("<u4"),
            "ring": np.dtype("<u2"), "semantic": np.dtype("u1"), "instance": np.dtype("<u2")}


def _vector(message):
    return np.array([message.x, message.y, message.z])


def _quaternion(message):
    return np.array([message.w, message.x, message.y, message.z])


def _imu(sample):
    return {"angular_rate_S_radps": _vector(sample.angular_rate_S_radps),
            "specific_force_S_mps2": _vector(sample.specific_force_S_mps2)}


def _gnss(sample):
    return {"fix": sample.fix, "geodetic": np.array([sample.lat_deg, sample.lon_deg, sample.height_m]),
            "enu_m": _vector(sample.enu_m), "variance_enu_m2": _vector(sample.variance_enu_m2)}


def _encoder(sample):
    return {"position": np.array(sample.position), "rate": np.array(sample.rate)}


_LABEL_FORMS = {1: (np.uint8, ()), 2: (np.uint16, ()), 3: (np.uint8, (3,)), 6: (np.uint16, (3,))}  # by bytes of a pixel


def _label_picture(data, height_px, width_px):
    dtype, components = _LABEL_FORMS[len(data) // (height_px * width_px)]
    return np.frombuffer(data, np.dtype(dtype).newbyteorder("<")).reshape((height_px, width_px) + components)


def _camera(frame):
    arrays = {}
    for name, dtype in _PICTURES.items():
        data = getattr(frame, name)
        if data:
            shape = (frame.height_px, frame.width_px) + ((3,) if name == "rgb" else ())
            arrays[name] = np.frombuffer(data, dtype).reshape(shape)
    with_fields = {name: getattr(frame, name) for name in _LABEL_FIELDS}
    for name, data in {**with_fields, **frame.labels}.items():
        if not data:
            continue
        arrays[name] = _label_picture(data, frame.height_px, frame.width_px)
    return arrays


def _lidar(scan):
    arrays = {name: np.frombuffer(getattr(scan, name), dtype) for name, dtype in _COLUMNS.items()}
    arrays["xyz_S_m"] = arrays["xyz_S_m"].reshape(-1, 3)
    return arrays


def _row(sample):
    return {"value": np.array(sample.value)}


_DECODERS = {"imu": _imu, "gnss": _gnss, "encoder": _encoder, "camera": _camera, "lidar": _lidar, "row": _row}


def decode(samples):
    """The samples of a SensorSamples message as dicts of arrays, oldest first."""
    for kind, decoder in _DECODERS.items():
        found = getattr(samples, kind)
        if found:
            return [{"time_ns": s.time_ns, "available_ns": s.available_ns, **decoder(s)} for s in found]
    return []


def _sensor_spaces(sensor):
    name = sensor.name
    if sensor.HasField("camera"):
        camera = sensor.camera
        shape = (camera.height_px, camera.width_px)
        spaces = {}
        if camera.rgb:
            spaces[f"{name}/rgb"] = Box(0, 255, shape + (3,), np.uint8)
        if camera.depth:
            spaces[f"{name}/depth_m"] = Box(0.0, np.inf, shape, np.float32)
        for channel in camera.label_channels:
            dtype, components = _LABEL_FORMS[channel.components * channel.component_bytes]
            spaces[f"{name}/{channel.name}"] = Box(0, np.iinfo(dtype).max, shape + components, dtype)
        return spaces
    shapes = {"imu": (6,), "gnss": (4,), "encoder": (2, len(sensor.encoder_axes))}
    if sensor.columns:
        shapes[sensor.type] = (len(sensor.columns),)
    return {name: Box(-np.inf, np.inf, shapes[sensor.type], np.float64)} if sensor.type in shapes else {}


def _latest_arrays(sensor, latest):
    """What an observation holds of a sensor whose latest measurement is `latest`, None before the first."""
    spaces = _sensor_spaces(sensor)
    if latest is None:
        return {name: np.zeros(space.shape, space.dtype) for name, space in spaces.items()}
    if sensor.HasField("camera"):
        return {name: latest[name.rpartition("/")[2]] for name in spaces}
    if sensor.type == "imu":
        return {sensor.name: np.concatenate([latest["angular_rate_S_radps"], latest["specific_force_S_mps2"]])}
    if sensor.type == "gnss":
        return {sensor.name: np.append(latest["enu_m"], latest["fix"])}
    if sensor.type == "encoder":
        return {sensor.name: np.stack([latest["position"], latest["rate"]])}
    if sensor.columns:
        return {sensor.name: latest["value"]}
    return {}
