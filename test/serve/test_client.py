"""The Python client against `tera serve`, both as a user has them."""

import importlib.util
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import textwrap
import time
import unittest
from pathlib import Path
from unittest import mock

import grpc
import numpy as np

import tera

SCENARIO = """
name: client
seed: 5
duration_s: 1
settle_s: 0.1
terrain: {size_m: [14, 14], cell_m: 0.1, soil: dirt, relief: {amplitude_m: 0.1, wavelength_m: 4}}
machines:
  - name: mast
    machine: tera:config/machines/mast.yaml
    start: {xy_m: [-5, -5]}
    operator: {type: idle}
    rig: {sensors: []}
  - name: digger
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [0.5, -1], yaw_deg: 40, joints_deg: {boom: 40, arm: -95, bucket: -20}}
    operator: {type: idle}
    rig: {sensors: [
      {name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, link: upper, xyz_m: [0, 0.2, 1], rate_hz: 50},
      {name: gnss, preset: tera:config/sensors/rtk_f9p.yaml, link: upper, xyz_m: [-0.9, 0.5, 1.2], rate_hz: 5},
      {name: camera, preset: tera:config/sensors/realsense_d435i.yaml, link: upper, xyz_m: [0.8, 0.3, 1.8],
       rpy_deg: [0, 30, 0], width_px: 64, height_px: 48, rate_hz: 10},
      {name: lidar, preset: tera:config/sensors/vlp16.yaml, link: upper, xyz_m: [0, 0.3, 2.1], columns: 64},
      {name: encoders, preset: tera:config/sensors/encoder.yaml}]}
"""


def setUpModule():
    global folder, scenario, server
    folder = tempfile.TemporaryDirectory()
    scenario = Path(folder.name) / "client.yaml"
    scenario.write_text(SCENARIO)
    server = tera.Server(scenario)


def tearDownModule():
    server.close()
    folder.cleanup()


def running(pid):
    """Whether the process does; one that has ended and waits for its parent does not."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def equal(a, b):
    return a.keys() == b.keys() and all(np.array_equal(a[name], b[name]) for name in a)


def rotation(w, x, y, z):
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def pose(message):
    """A Pose as a matrix."""
    p, q = message.position_m, message.rotation
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = rotation(q.w, q.x, q.y, q.z), [p.x, p.y, p.z]
    return matrix


def turn(axis, angle):
    matrix = np.eye(4)
    matrix[:3, :3] = rotation(np.cos(angle / 2), *(np.sin(angle / 2) * np.array(axis)))
    return matrix


def files(directory):
    """The bytes of every file below, by its path."""
    return {path.relative_to(directory): path.read_bytes() for path in directory.rglob("*") if path.is_file()}


class EnvTest(unittest.TestCase):
    def env(self, **options):
        env = tera.Env(server.address, **options)
        self.addCleanup(env.close)
        return env

    def test_reset_with_one_seed_twice_gives_equal_observations(self):
        env = self.env(sensors=["imu", "gnss", "camera", "encoders"], patch=tera.Patch(3, 0.5))
        boom_down = np.where([lever.name == "boom" for lever in env.machine.levers], -0.5, 0.0)

        def episode(seed):
            told = [env.reset(seed=seed)[0]]
            return told + [env.step(boom_down)[0] for _ in range(3)]

        first, again, other = episode(1), episode(1), episode(2)
        self.assertTrue(all(equal(a, b) for a, b in zip(first, again)))
        self.assertFalse(np.array_equal(first[-1]["imu"], other[-1]["imu"]))

    def test_the_first_reset_without_a_seed_takes_that_of_the_scenario_and_later_ones_others(self):
        env = self.env(sensors=["gnss"])
        unseeded = [env.reset() for _ in range(3)]
        self.assertEqual(unseeded[0][1]["seed"], 5)
        self.assertEqual(len({info["seed"] for _, info in unseeded}), 3)
        self.assertFalse(equal(unseeded[0][0], unseeded[1][0]))
        self.assertTrue(equal(unseeded[0][0], env.reset(seed=5)[0]))
        self.assertTrue(equal(unseeded[1][0], env.reset()[0]))  # the same calls, the same episodes
        self.assertTrue(equal(unseeded[2][0], env.reset(seed=unseeded[2][1]["seed"])[0]))

    def test_a_step_before_a_reset_is_told_and_does_no_harm(self):
        env = self.env()
        still = np.zeros(env.action_space.shape)
        with self.assertRaisesRegex(RuntimeError, "step before reset"):
            env.step(still)
        env.reset(seed=1)
        env.step(still)

    def test_steps_last_as_asked_and_the_episode_is_truncated_at_its_duration(self):
        env = self.env(step_s=0.25)
        _, info = env.reset(seed=1)
        self.assertEqual(info["time_s"], 0)
        still = np.zeros(env.action_space.shape)
        told = [env.step(still) for _ in range(4)]
        for k, (_, _, terminated, _, info) in enumerate(told):
            self.assertAlmostEqual(info["time_s"], 0.25 * (k + 1), places=9)
            self.assertFalse(terminated)
        self.assertEqual([truncated for _, _, _, truncated, _ in told], [False, False, False, True])

    def test_the_first_machine_with_levers_is_driven_unless_another_is_named(self):
        env = self.env()
        self.assertEqual(env.machine.name, "digger")
        env.close()
        with self.assertRaisesRegex(ValueError, "no machine 'mast' with levers; need one of: digger"):
            self.env(machine="mast")

    def test_levers_move_the_machine_and_are_observed(self):
        env = self.env(step_s=0.3)
        joints = [joint.name for joint in env.machine.joints]
        before, _ = env.reset(seed=1)
        action = np.array([-0.5 if lever.name == "boom" else 0.0 for lever in env.machine.levers], np.float32)
        after = env.step(action)[0]
        boom = joints.index("boom")
        self.assertLess(after["joint_position"][boom], before["joint_position"][boom] - 0.02)
        np.testing.assert_allclose(after["levers"], action)

    def test_joint_positions_are_held(self):
        env = self.env(step_s=0.5, control="joint_positions")
        before, _ = env.reset(seed=1)
        joints = [joint.name for joint in env.machine.joints]
        hold = np.array([before["joint_position"][joints.index(lever.joint)] if lever.joint else 0.0
                         for lever in env.machine.levers])
        after = env.step(hold)[0]
        np.testing.assert_allclose(after["joint_position"], before["joint_position"], atol=0.02)

    def test_a_tool_comes_to_the_position_asked_for(self):
        env = self.env(step_s=1.0, control="tool_position", tool_frame="bucket_tip")
        self.assertEqual(env.action_space.shape, (3,))
        env.reset(seed=1)
        for target in ([3.0, 0.5, 1.0], [4.0, -0.5, 0.8]):
            left_m = [np.linalg.norm(env.step(target)[0]["tool_position_B_m"] - target) for _ in range(7)]
            self.assertLess(left_m[1], left_m[0])
            self.assertLess(left_m[-1], 0.03)

    def test_the_tool_is_where_the_joints_of_the_description_put_it(self):
        env = self.env(step_s=0.5)
        env.reset(seed=1)
        env.action_space.seed(4)
        observation = env.step(env.action_space.sample())[0]
        machine = env.machine
        frame = machine.frames[0]
        joint_of = {joint.child: (joint, q) for joint, q in zip(machine.joints, observation["joint_position"])}
        place, link = pose(frame.X_BF), frame.link
        while link in joint_of:
            joint, q = joint_of[link]
            place = pose(joint.X_PJ) @ turn([joint.axis_J.x, joint.axis_J.y, joint.axis_J.z], q) @ place
            link = joint.parent
        np.testing.assert_allclose(observation["tool_position_B_m"], place[:3, 3], atol=1e-9)
        w, x, y, z = observation["tool_rotation_B"]
        np.testing.assert_allclose(rotation(w, x, y, z), place[:3, :3], atol=1e-9)

    def test_cylinders_are_as_long_as_their_pins_are_apart(self):
        env = self.env(step_s=0.5)
        env.reset(seed=1)
        raised = np.where([lever.name == "boom" for lever in env.machine.levers], 0.5, 0.0)
        observation, _, _, _, info = env.step(raised)
        names = [cylinder.name for cylinder in env.machine.cylinders]
        state = next(m for m in info["message"].machines if m.name == "digger")
        for k, (cylinder, now) in enumerate(zip(env.machine.cylinders, state.cylinder)):
            pins = [np.array([p.x, p.y, p.z]) for p in (now.barrel_pin_B_m, now.rod_pin_B_m)]
            self.assertAlmostEqual(np.linalg.norm(pins[1] - pins[0]), now.length_m, places=9)
            self.assertAlmostEqual(now.length_m - cylinder.shortest_m, observation["cylinder_stroke_m"][k])
        boom = state.cylinder[names.index("boom_cylinder")]
        self.assertGreater(boom.rate_mps, 0.01)
        # It pushes, and carries boom, arm and bucket by the pressure under its piston.
        area_m2 = np.pi / 4 * env.machine.cylinders[names.index("boom_cylinder")].bore_m ** 2
        head_pa, rod_pa = observation["cylinder_pressure_pa"][names.index("boom_cylinder")]
        self.assertGreater(head_pa, 1e6)
        self.assertGreater(head_pa, rod_pa)
        self.assertLess(abs(head_pa * area_m2 / boom.force_n - 1), 0.3)

    def test_actions_beyond_a_bound_by_a_rounding_are_done_and_others_refused(self):
        env = self.env(control="joint_rates")
        env.reset(seed=1)
        env.step(env.action_space.high.astype(np.float32))
        for wrong in (np.zeros(2), np.zeros((1,) + env.action_space.shape)):
            with self.assertRaisesRegex(ValueError, "need"):
                env.step(wrong)
        levers = self.env_of_levers(env)
        with self.assertRaisesRegex(tera.Refused, "need -1 to 1"):
            levers.step(np.full(levers.action_space.shape, 1.5))
        levers.step(np.zeros(levers.action_space.shape))  # goes on

    def env_of_levers(self, env):
        env.close()
        levers = self.env()
        levers.reset(seed=1)
        return levers

    def test_pictures_have_the_cameras_shape_and_hold_a_scene(self):
        env = self.env(sensors=["camera"])
        observation, info = env.reset(seed=1)
        self.assertEqual(observation["camera/rgb"].shape, (48, 64, 3))
        self.assertEqual(observation["camera/rgb"].dtype, np.uint8)
        self.assertEqual(observation["camera/depth_m"].shape, (48, 64))
        self.assertEqual(observation["camera/depth_m"].dtype, np.float32)
        self.assertEqual(observation["camera/instance"].dtype, np.uint16)
        self.assertEqual(info["age_s"], {"camera": 0.0})
        self.assertGreater(observation["camera/rgb"].std(), 5)
        names = {c.value: c.name for c in env.session.description.semantic_classes}
        self.assertIn("terrain", {names[value] for value in np.unique(observation["camera/semantic"])})
        depth_m = observation["camera/depth_m"]
        self.assertTrue(np.any(depth_m > 0.5) and depth_m.max() < 30)

    def test_a_picture_stays_until_the_next_is_taken(self):
        env = self.env(sensors=["camera"], step_s=0.05)
        first, _ = env.reset(seed=1)
        swing = np.where([lever.name == "swing" for lever in env.machine.levers], 1.0, 0.0)
        same, _, _, _, info = env.step(swing)
        np.testing.assert_array_equal(same["camera/rgb"], first["camera/rgb"])
        self.assertAlmostEqual(info["age_s"]["camera"], 0.05)
        self.assertEqual(info["samples"]["camera"], [])
        _, _, _, _, info = env.step(swing)
        self.assertEqual(info["age_s"]["camera"], 0.0)
        self.assertEqual(len(info["samples"]["camera"]), 1)

    def test_all_frames_of_a_step_are_there_if_asked_for(self):
        for all_frames, count in ((False, 1), (True, 3)):
            env = self.env(sensors=["camera", "lidar"], step_s=0.3, all_frames=all_frames)
            env.reset(seed=1)
            _, _, _, _, info = env.step(np.zeros(env.action_space.shape))
            self.assertEqual(len(info["samples"]["camera"]), count)
            self.assertEqual(len(info["samples"]["lidar"]), count)
            self.assertEqual(info["samples"]["camera"][-1]["time_ns"], 300_000_000)
            scan = info["samples"]["lidar"][-1]
            self.assertGreater(len(scan["xyz_S_m"]), 100)
            self.assertEqual(len(scan["xyz_S_m"]), len(scan["ring"]))
            env.close()

    def test_small_sensors_measure_what_they_should(self):
        env = self.env(sensors=["imu", "gnss", "encoders"], step_s=0.5)
        observation, info = env.reset(seed=1)
        np.testing.assert_array_equal(observation["imu"], np.zeros(6))  # none yet
        self.assertIsNone(info["age_s"]["imu"])
        observation, _, _, _, info = env.step(np.zeros(env.action_space.shape))
        self.assertAlmostEqual(np.linalg.norm(observation["imu"][3:]), 9.81, delta=0.3)
        self.assertEqual(len(info["samples"]["imu"]), 24)  # the 25th is known a physics step later
        self.assertEqual(observation["gnss"][3], 4)  # a fixed RTK solution
        p = observation["base_position_W_m"]
        self.assertLess(np.linalg.norm(observation["gnss"][:2] - p[:2]), 1.5)
        moving = [j.name for j in env.machine.joints if j.type != tera.messages.Joint.FIXED]
        self.assertEqual(observation["encoders"].shape, (2, len(moving)))
        np.testing.assert_allclose(observation["encoders"][0], observation["joint_position"][:len(moving)], atol=0.05)

    def test_the_terrain_around_the_machine_is_about_as_high_as_its_tracks(self):
        env = self.env(patch=tera.Patch(2.0, 0.25))
        observation, _ = env.reset(seed=1)
        self.assertEqual(observation["terrain_m"].shape, (9, 9))
        self.assertLess(np.abs(observation["terrain_m"]).max(), 0.5)
        self.assertGreater(observation["terrain_m"].std(), 0)

    def test_observations_and_actions_are_of_their_spaces(self):
        env = self.env(sensors=["imu", "gnss", "camera", "encoders", "lidar"], patch=tera.Patch(2.0, 0.25))
        observation, _ = env.reset(seed=1)
        self.assertTrue(env.observation_space.contains(observation))
        env.action_space.seed(3)
        observation = env.step(env.action_space.sample())[0]
        self.assertTrue(env.observation_space.contains(observation))
        self.assertEqual(set(env.observation_space.spaces), set(observation))
        self.assertFalse(env.action_space.contains(np.full(env.action_space.shape, 2.0)))

    def test_reward_and_end_are_the_users_own_functions(self):
        def lifted(observation, info):
            return observation["joint_position"][0] + 100 * info["time_s"]

        env = self.env(reward=lifted, terminated=lambda observation, info: info["time_s"] > 0.15)
        env.reset(seed=1)
        still = np.zeros(env.action_space.shape)
        observation, reward, terminated, _, _ = env.step(still)
        self.assertAlmostEqual(reward, observation["joint_position"][0] + 10)
        self.assertFalse(terminated)
        self.assertTrue(env.step(still)[2])
        env.close()
        plain = self.env()
        plain.reset(seed=1)
        self.assertEqual(plain.step(still)[1], 0.0)

    def test_wrong_options_are_refused_and_leave_the_server_free(self):
        with self.assertRaisesRegex(ValueError, "no sensor 'radar' on digger; need one of: imu, gnss, camera"):
            self.env(sensors=["radar"])
        with self.assertRaisesRegex(ValueError, "need one of levers"):
            self.env(control="thoughts")
        with self.assertRaisesRegex(ValueError, "no frame 'hook' on digger; need one of: bucket_tip"):
            self.env(tool_frame="hook")
        with self.assertRaisesRegex(ValueError, "step_s 0; need a time"):
            self.env(step_s=0)
        env = self.env(patch=tera.Patch(2, 0.5, shovel="spoon"))
        with self.assertRaisesRegex(tera.Refused, "named 'spoon'"):
            env.reset(seed=1)


class GymnasiumTest(unittest.TestCase):
    """What gymnasium.utils.env_checker.check_env asks of an environment; itself, where Gymnasium is installed."""

    def env(self):
        env = tera.Env(server.address, sensors=["imu", "gnss", "camera", "encoders"], patch=tera.Patch(2.0, 0.25))
        self.addCleanup(env.close)
        return env

    def assert_in_space(self, env, observation):
        self.assertIsInstance(observation, dict)
        self.assertIn(observation, env.observation_space)
        for name, value in observation.items():
            self.assertIsInstance(value, np.ndarray)
            self.assertEqual(value.dtype, env.observation_space[name].dtype, name)

    def test_the_contract_is_kept(self):
        env = self.env()
        observation, info = env.reset()
        self.assert_in_space(env, observation)
        self.assertIsInstance(info, dict)
        first, again, other = env.reset(seed=123)[0], env.reset(seed=123)[0], env.reset(seed=456)[0]
        self.assertTrue(equal(first, again))
        self.assertFalse(equal(first, other))
        self.assert_in_space(env, env.reset(options={})[0])
        result = env.step(env.action_space.sample())
        self.assertEqual([type(part) for part in result[1:]], [float, bool, bool, dict])
        self.assert_in_space(env, result[0])
        env.close()
        env.close()

    def test_options_of_a_reset_that_mean_nothing_are_refused(self):
        with self.assertRaisesRegex(ValueError, "options of a reset: wind; need none"):
            self.env().reset(options={"wind": 3})

    def test_a_prepared_reset_gives_what_an_unprepared_one_does(self):
        prepared = self.env()
        told = [prepared.reset(seed=6)[0], prepared.reset()[0]]
        prepared.close()
        plain = tera.Env(server.address, prepare=False, sensors=["imu", "gnss", "camera", "encoders"],
                         patch=tera.Patch(2.0, 0.25))
        self.addCleanup(plain.close)
        for one, other in zip(told, [plain.reset(seed=6)[0], plain.reset()[0]]):
            self.assertTrue(equal(one, other))

    @unittest.skipUnless(importlib.util.find_spec("gymnasium"), "Gymnasium is not installed")
    def test_gymnasiums_own_check_passes(self):
        from gymnasium.utils.env_checker import check_env
        check_env(self.env(), skip_render_check=True)

    @unittest.skipUnless(importlib.util.find_spec("gymnasium"), "Gymnasium is not installed")
    def test_the_vector_is_gymnasiums(self):
        from gymnasium.vector import VectorEnv
        envs = tera.VectorEnv(server.address, 2)
        self.addCleanup(envs.close)
        self.assertIsInstance(envs, VectorEnv)


DRAWN = SCENARIO + """
randomise:
  - {key: 'machines[1].start.yaw_deg', uniform: [-90, 90]}
  - {key: terrain.soil, choice: [dirt, sand, gravel]}
"""


class VectorEnvTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        drawn = Path(folder.name) / "drawn.yaml"
        drawn.write_text(DRAWN)
        cls.drawn = tera.Server(drawn)
        cls.addClassCleanup(cls.drawn.close)

    def envs(self, num_envs=3, **options):
        envs = tera.VectorEnv(self.drawn.address, num_envs, **options)
        self.addCleanup(envs.close)
        return envs

    def test_each_environment_is_what_it_would_be_alone_in_the_yard_of_its_seed(self):
        options = {"sensors": ["imu", "camera"], "reward": "load_kg - 1e-3 * work_j", "step_s": 0.2}
        envs = self.envs(**options)
        action = np.where([lever.name == "boom" for lever in envs.machine.levers], -0.5, 0.0)
        stacked = [envs.reset(seed=7)[0]]
        rewards = []
        for _ in range(2):
            observation, reward, _, _, info = envs.step(np.stack([action] * 3))
            stacked.append(observation)
            rewards.append(reward)
        np.testing.assert_array_equal(info["seed"], [7, 8, 9])
        self.assertFalse(np.allclose(stacked[0]["base_rotation_WB"][0], stacked[0]["base_rotation_WB"][1]))
        envs.close()
        env = tera.Env(self.drawn.address, **options)
        self.addCleanup(env.close)
        for k in range(3):
            told = [env.reset(seed=7 + k)[0]]
            for step in range(2):
                observation, reward, *_ = env.step(action)
                told.append(observation)
                self.assertEqual(reward, rewards[step][k])
            for one, all_of_them in zip(told, stacked):
                self.assertTrue(equal(one, {name: value[k] for name, value in all_of_them.items()}))

    def test_an_episode_that_is_over_begins_the_next_by_the_following_step(self):
        envs = self.envs(2, step_s=0.5, terminated="time_s > 0.4 and x_m < 1e9", reward="1")
        envs.reset(seed=[3, 30])
        still = np.zeros(envs.action_space.shape)
        _, reward, terminations, truncations, info = envs.step(still)
        self.assertTrue(terminations.all())
        self.assertFalse(truncations.any())
        np.testing.assert_array_equal(reward, [1, 1])
        _, reward, terminations, _, after = envs.step(still)
        np.testing.assert_array_equal(reward, [0, 0])
        self.assertFalse(terminations.any())
        np.testing.assert_array_equal(after["time_s"], [0, 0])
        self.assertFalse(np.any(after["seed"] == info["seed"]))
        again = tera.vector.Seeds(0)
        again.begin(3)
        self.assertEqual(again.begin()[0], after["seed"][0])  # that of Env.reset()

    def test_a_faulty_action_takes_no_seed(self):
        envs = self.envs(2, step_s=0.1, terminated=lambda observation, info: info["seed"] == 3)
        envs.reset(seed=[3, 30])
        still = np.zeros(envs.action_space.shape)
        envs.step(still)
        with self.assertRaisesRegex(ValueError, "action of shape"):
            envs.step([still[0], still[1][:-1]])
        seeds = tera.vector.Seeds(0)
        seeds.begin(3)
        np.testing.assert_array_equal(envs.step(still)[4]["seed"], [seeds.begin()[0], 30])

    def test_spaces_hold_what_is_stacked(self):
        envs = self.envs(2, sensors=["imu", "gnss", "camera"], patch=tera.Patch(2.0, 0.25))
        observation, _ = envs.reset(seed=1)
        self.assertTrue(envs.observation_space.contains(observation))
        self.assertEqual(set(observation), set(envs.observation_space.spaces))
        envs.action_space.seed(2)
        action = envs.action_space.sample()
        self.assertEqual(action.shape, (2,) + envs.single_action_space.shape)
        observation, reward, terminations, truncations, _ = envs.step(action)
        self.assertTrue(envs.observation_space.contains(observation))
        self.assertEqual([a.dtype for a in (reward, terminations, truncations)], [np.float64, bool, bool])

    def test_wrong_calls_are_refused(self):
        with self.assertRaisesRegex(ValueError, "num_envs 65; need at most 64"):
            self.envs(65)
        with self.assertRaisesRegex(ValueError, "num_envs 0"):
            self.envs(0)
        envs = self.envs(2)
        still = np.zeros(envs.action_space.shape)
        with self.assertRaisesRegex(RuntimeError, "step before reset"):
            envs.step(still)
        with self.assertRaisesRegex(ValueError, "3 seeds; need 2"):
            envs.reset(seed=[1, 2, 3])
        envs.reset(seed=1)
        with self.assertRaisesRegex(ValueError, "1 actions; need 2"):
            envs.step(still[:1])
        still[1] = 2
        with self.assertRaisesRegex(tera.Refused, "environment 1: .*need -1 to 1"):
            envs.step(still)

    def test_a_machine_that_the_draw_changes_is_seen_so(self):
        heavier = Path(folder.name) / "heavier.yaml"
        heavier.write_text(SCENARIO + """
randomise:
  - {key: terrain.size_m, choice: [[14, 14], [16, 16]]}
""")
        with tera.Server(heavier) as server, tera.Session(server.address) as session:
            sizes = set()
            for seed in range(8):
                anew = session.reset(seed=seed).described_anew
                before, session.description = session.description, session.describe()
                self.assertEqual(anew, before != session.description)
                sizes.add(session.description.site.x_max_m)
            self.assertEqual(sizes, {7.0, 8.0})


class TruthTest(unittest.TestCase):
    def test_expressions_read_the_truth_after_a_step(self):
        env = tera.Env(server.address, step_s=0.2, reward="max(tilt_rad, 0) + 2 * (time_s > 0.1) - change_work_j",
                       terminated="touches > 0 or tilt_rad > 0.5")
        self.addCleanup(env.close)
        _, info = env.reset(seed=1)
        self.assertEqual(info["truth"]["change_work_j"], 0)
        up = np.where([lever.name == "boom" for lever in env.machine.levers], 0.5, 0.0)
        observation, reward, terminated, _, info = env.step(up)
        truth = info["truth"]
        self.assertAlmostEqual(reward, truth["tilt_rad"] + 2 - truth["work_j"])
        self.assertGreater(truth["work_j"], 10)
        self.assertFalse(terminated)
        w, x, y, z = observation["base_rotation_WB"]
        self.assertAlmostEqual(np.cos(truth["tilt_rad"]), rotation(w, x, y, z)[2, 2], places=9)
        np.testing.assert_allclose([truth[name] for name in ("x_m", "y_m", "z_m")], observation["base_position_W_m"])

    def test_what_is_no_expression_is_refused_before_a_server_is_asked(self):
        for text, words in (("tilt > 1", "no truth 'tilt'; need one of time_s"), ("__import__('os')", "no function"),
                            ("touches.real", "Attribute is not possible"), ("load_kg >", "need one of Python's"),
                            ("sin(x_m, key=1)", "Call is not possible"), ("'text'", "is no number"),
                            ("[x_m]", "List is not possible"), ("max", "no truth 'max'")):
            with self.assertRaisesRegex(ValueError, words):
                tera.Env("127.0.0.1:1", reward=text)


class SessionTest(unittest.TestCase):
    def test_a_second_client_is_refused(self):
        with tera.Session(server.address, client="first"):
            with self.assertRaisesRegex(tera.SessionEnded, "busy with first at ipv4:127.0.0.1") as caught:
                tera.Session(server.address)
            self.assertEqual(caught.exception.code, grpc.StatusCode.RESOURCE_EXHAUSTED)
        tera.Session(server.address).close()

    def test_where_no_server_is_the_client_says_so(self):
        with self.assertRaisesRegex(tera.SessionEnded, "no server answers at 127.0.0.1:1"):
            tera.Session("127.0.0.1:1", timeout_s=0.2)

    def test_an_answer_to_another_request_ends_the_session(self):
        with tera.Session(server.address) as session:
            session.reset(seed=1)
            session._requests.put(tera.messages.Request(sequence=4, describe=tera.messages.Describe()))
            session._sequence += 1  # its answer is not waited for
            with self.assertRaisesRegex(tera.SessionEnded, "answer 4 to request 5"):
                session.step(physics_steps=1)

    def test_a_refusal_says_whether_the_episode_is_over(self):
        record = Path(folder.name) / "faulty"
        with tera.make(scenario, options=["--record", record], step_s=0.5) as env:
            env.reset(seed=1)
            still = np.zeros(env.action_space.shape)
            with self.assertRaises(tera.Refused) as caught:
                env.session.step(physics_steps=0)
            self.assertFalse(caught.exception.episode_over)
            shutil.rmtree(record / "episode_0001.incomplete" / "digger" / "camera")
            with self.assertRaisesRegex(tera.Refused, "kept in") as caught:
                for _ in range(100):
                    env.step(still)
            self.assertTrue(caught.exception.episode_over)
            env.reset(seed=1)
            env.step(still)

    def test_a_broken_rule_ends_the_session(self):
        session = tera.Session(server.address)
        with self.assertRaisesRegex(tera.SessionEnded, "Step before any Reset"):
            session.step(physics_steps=1)
        with self.assertRaises(tera.SessionEnded):
            session.reset(seed=1)
        session.close()
        tera.Session(server.address).close()

    def test_a_client_that_is_killed_in_the_middle_of_a_step_frees_the_server(self):
        script = textwrap.dedent(f"""
            import tera
            session = tera.Session({server.address!r})
            session.reset(seed=1)
            print("stepping", flush=True)
            session.step(duration_s=3600)
            """)
        client = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
        self.assertEqual(client.stdout.readline(), "stepping\n")
        client.send_signal(signal.SIGKILL)
        client.wait()
        client.stdout.close()
        while True:
            try:
                with tera.Session(server.address) as session:
                    self.assertEqual(session.reset(seed=1).time_ns, 0)
                return
            except tera.SessionEnded as busy:
                self.assertEqual(busy.code, grpc.StatusCode.RESOURCE_EXHAUSTED)


class ServerTest(unittest.TestCase):
    def test_the_server_ends_with_the_program_that_started_it(self):
        script = f"import tera; print(tera.Server({str(scenario)!r})._process.pid, flush=True); input()"
        parent = subprocess.Popen([sys.executable, "-c", script], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                  text=True)
        child = int(parent.stdout.readline())
        os.kill(child, 0)  # it is there
        parent.kill()
        parent.communicate()
        deadline = time.monotonic() + 60
        while running(child):
            self.assertLess(time.monotonic(), deadline, "the server goes on without its parent")
            time.sleep(0.05)

    def test_where_no_program_is_one_hears_where_it_was_looked_for(self):
        with mock.patch.dict(os.environ, {"TERA_PROGRAM": "/nowhere/tera"}):
            with self.assertRaisesRegex(FileNotFoundError, "TERA_PROGRAM names /nowhere/tera"):
                tera.server.find_program()
        with mock.patch.dict(os.environ, {"PATH": "/nowhere"}):
            os.environ.pop("TERA_PROGRAM", None)
            with mock.patch("tera.server._PACKAGE", Path("/tera")):
                with self.assertRaisesRegex(FileNotFoundError, "not on the PATH.*name it in TERA_PROGRAM"):
                    tera.server.find_program()

    def test_the_program_of_a_build_and_of_an_installation_is_found(self):
        for package, program in (("build/python/tera", "build/tera"),
                                 ("prefix/share/tera/python/tera", "prefix/bin/tera")):
            root = Path(folder.name) / "places"
            (root / program).parent.mkdir(parents=True, exist_ok=True)
            (root / program).write_text("")
            (root / program).chmod(0o755)
            with mock.patch.dict(os.environ), mock.patch("tera.server._PACKAGE", root / package):
                os.environ.pop("TERA_PROGRAM", None)
                self.assertEqual(tera.server.find_program(), str(root / program))

    def test_a_killed_episode_is_replayed_as_far_as_it_was_commanded(self):
        record, again = Path(folder.name) / "killed", Path(folder.name) / "killed_again"
        own = tera.Server(scenario, ["--record", record])
        session = tera.Session(own.address)
        session.reset(seed=8)
        session.step(duration_s=2.5)
        own._process.kill()
        own._process.wait()
        session.close()
        own.close()
        subprocess.run([tera.server.find_program(), "replay", record / "episode_0001.incomplete", "--out", again],
                       check=True, capture_output=True)
        rows = (again / "digger" / "commands.csv").read_text().splitlines()
        self.assertGreaterEqual(len(rows), 2 * 500)

    def test_a_folder_for_recordings_that_cannot_be_written_ends_the_server_at_its_start(self):
        file = Path(folder.name) / "in_the_way"
        file.write_text("")
        for record in (file, file / "inside", Path("/proc")):
            ended = subprocess.run([tera.server.find_program(), "serve", scenario, "--port", "0", "--record", record],
                                   stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300)
            self.assertEqual(ended.returncode, 2)
            self.assertIn(str(record), ended.stderr)
            self.assertEqual(ended.stdout, "")

    def test_a_wrong_scenario_is_reported(self):
        with self.assertRaisesRegex(RuntimeError, "nowhere.yaml"):
            tera.Server("nowhere.yaml")

    def test_episodes_are_recorded(self):
        record = Path(folder.name) / "episodes"
        with tera.make(scenario, options=["--record", record]) as env:
            env.reset(seed=1)
            env.step(np.zeros(env.action_space.shape))
        commands = (record / "episode_0001" / "digger" / "commands.csv").read_text().splitlines()
        self.assertEqual(len(commands), 1 + 50 + 1)  # 0.1 s at 500 Hz, and in force from there on

    def test_a_recorded_episode_replays_to_the_same_bytes(self):
        record, again = Path(folder.name) / "to_replay", Path(folder.name) / "replayed"
        with tera.make(scenario, options=["--record", record], control="joint_rates", step_s=0.15) as env:
            env.reset(seed=8)
            env.action_space.seed(1)
            for _ in range(3):
                env.step(env.action_space.sample())
        episode = record / "episode_0001"
        subprocess.run([tera.server.find_program(), "replay", episode, "--out", again], check=True,
                       capture_output=True)
        self.assertEqual(files(episode), files(again))

    def test_a_scenario_that_changes_while_it_is_served_is_served_as_it_was(self):
        changing = Path(folder.name) / "changing.yaml"
        changing.write_text(SCENARIO)
        with tera.make(changing) as env:
            changing.write_text("broken")
            env.reset(seed=2)

    def test_a_server_that_is_stopped_says_goodbye_and_ends_well(self):
        own = tera.Server(scenario)
        session = tera.Session(own.address)
        session.reset(seed=1)
        own._process.send_signal(signal.SIGTERM)
        self.assertEqual(own._process.wait(), 0)
        with self.assertRaisesRegex(tera.SessionEnded, "the server is being stopped"):
            session.step(physics_steps=1)
        session.close()
        own.close()
        self.assertIn("session begun", own.said())


if __name__ == "__main__":
    unittest.main()
