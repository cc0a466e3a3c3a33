"""One machine of a scenario as an environment in Gymnasium's form."""

import numpy as np

from tera.machine_io import MachineIo
from tera.server import Server
from tera.session import Refused, Session
from tera.spaces import EnvBase
from tera.truth import function_of


class Seeds:
    """The seeds of an environment's episodes, the next one known before it begins."""

    def __init__(self, own):
        self._own, self._generator = own, None

    def begin(self, seed=None):
        """The seed of the next episode, which is `seed` where one is given, and that of the one after it."""
        if seed is None and self._generator is not None:
            seed = self._next
        else:
            seed = self._own if seed is None else seed
            self._generator = np.random.default_rng(seed)
        self._next = int(self._generator.integers(2**32))
        return seed, self._next


class Env(EnvBase):
    """Steps one machine; the others go on with the scenario's own operators.

    address     of a server (tera.Server, or `tera serve`)
    machine     its name; the first that has levers, unless given
    control     what an action is: "levers" (-1 to 1 each), "joint_rates", "joint_positions" (one for each lever), or
                "tool_position" (where `tool_frame` is to go, x, y, z in the root link's frame, metres)
    tool_frame  the name of one of the machine's frames; its first, unless given
    step_s      simulated time of a step
    sensors     names of the machine's sensors to observe
    all_frames  every picture and scan of a step in info["samples"], not the latest of it alone
    patch       a Patch of terrain to observe
    reward      function of (observation, info), or an expression (tera.truth); 0.0 without it
    terminated  function of (observation, info), or an expression; never without it
    prepare     the server makes the next episode, by the seed that a reset without one will take, beside the steps of
                this one

    An observation is a dict of arrays: joint_position, joint_rate, joint_effort, gear_rate_radps, levers,
    base_position_W_m, base_rotation_WB (w, x, y, z), base_twist (velocity in W, angular velocity in B), shovel_load_kg;
    of `tool_frame`, where the machine has frames, tool_position_B_m and tool_rotation_B (w, x, y, z) in the root link's
    frame; cylinder_stroke_m and cylinder_pressure_pa (head and rod side) where it has cylinders;
    terrain_m (n x n, second index forward, relative to the patch's centre); and of each sensor the latest measurement:
    "<camera>/rgb", "<camera>/depth_m", "<camera>/<label channel>", "<imu>" (angular rate, specific
    force), "<gnss>" (east, north, up, fix), "<encoder>" (positions, rates), any other
    sensor of rows (the numbers of Sensor.columns). Until a sensor has measured something its
    arrays are 0. Lidars, whose scans differ in length, are in info["samples"] alone.

    info has time_s; seed, of the episode; truth, the names of expressions with their numbers; age_s, of each sensor the age of its latest measurement, or None before the first; samples, of each
    sensor a list of dicts of arrays, all that it measured in the step; and message, the server's own Observation.
    """

    metadata = {"render_modes": []}

    def __init__(self, address, reward=None, terminated=None, prepare=True, **options):
        self._server = None
        self._reward, self._terminated = function_of(reward, 0.0), function_of(terminated, False)
        self._prepare = prepare
        self._in_episode = False
        self.session = Session(address, client="tera.Env")
        try:
            self._io = MachineIo(self.session.description, **options)
            self._seeds = Seeds(self.session.description.seed)
        except BaseException:
            self.close()
            raise

    @property
    def machine(self):
        """Its description, as the episode has drawn it."""
        return self._io.machine

    @property
    def action_space(self):
        return self._io.action_space

    @property
    def observation_space(self):
        return self._io.observation_space

    # ---- Gymnasium's calls

    def reset(self, *, seed=None, options=None):
        """A fresh episode with that seed, by which the scenario's `randomise:` draws. There are no options.

        Without a seed, the first has the scenario's own, and each later one another, drawn from a generator that the
        last seed given (or the scenario's) began: the same calls give the same episodes.
        """
        if options:
            raise ValueError(f"options of a reset: {', '.join(options)}; need none")
        if seed is not None and EnvBase is not object:
            super().reset(seed=seed)
        self._seed, following = self._seeds.begin(seed)
        self._io.begin()
        self._in_episode = False
        told = self.session.reset(seed=self._seed, observe=self._io.observe,
                                  next_seed=following if self._prepare else None)
        if told.described_anew:
            self._io.redescribe(self.session.describe())
        self._in_episode = True
        return self._io.told(told, self._seed)[:2]

    def step(self, action):
        if not self._in_episode:
            raise RuntimeError("step before reset; need env.reset() first")
        try:
            told = self.session.step([self._io.action(action)], duration_s=self._io.step_s, observe=self._io.observe)
        except Refused as refused:
            self._in_episode = not refused.episode_over
            raise
        observation, info, truncated = self._io.told(told, self._seed)
        reward, terminated = self._reward(observation, info), self._terminated(observation, info)
        return observation, float(reward), bool(terminated), truncated, info

    def render(self):
        """Nothing: cameras are sensors."""

    def close(self):
        self.session.close()
        if self._server:
            self._server.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def make(scenario, options=(), **env_options):
    """An Env with a server of its own, which ends with it. `options` go to `tera serve`, the others to Env."""
    return with_server(Env, scenario, options, env_options)


def with_server(kind, scenario, options, env_options):
    """An environment of that kind with a server of its own."""
    server = Server(scenario, options)
    try:
        env = kind(server.address, **env_options)
    except BaseException:
        server.close()
        raise
    env._server = server
    return env
