"""Several environments of one server, stepped by one call, in the form of Gymnasium's VectorEnv."""

import numpy as np

from tera.env import Seeds, with_server
from tera.machine_io import MachineIo
from tera.session import Refused, Session
from tera.spaces import NEXT_STEP, VectorBase, batch_space
from tera.truth import function_of
from tera.v1 import simulation_pb2 as messages


class VectorEnv(VectorBase):
    """`num_envs` environments as tera.Env, with its options, each with its own episode in one server.

    Observations, rewards and ends are stacked: first index the environment. An environment whose episode has ended or
    been truncated begins the next one by the following step, which ignores its action and gives the reward 0
    (Gymnasium's AutoresetMode.NEXT_STEP). info holds arrays: time_s, seed, and truth by name; and messages, the
    server's own, a list.

    reset(seed=s) gives environment k the seed s + k, a list one to each; without a seed as tera.Env.reset, where the
    first ones count up from the scenario's.
    """

    metadata = {"render_modes": [], "autoreset_mode": NEXT_STEP}

    def __init__(self, address, num_envs, reward=None, terminated=None, prepare=True, **options):
        if num_envs < 1:
            raise ValueError(f"num_envs {num_envs}; need 1 or more")
        self._server = None
        self._reward, self._terminated = function_of(reward, 0.0), function_of(terminated, False)
        self._prepare = prepare
        self.session = Session(address, client="tera.VectorEnv")
        try:
            most = self.session.welcome.most_environments
            if num_envs > most:
                raise ValueError(f"num_envs {num_envs}; need at most {most}")
            description = self.session.description
            self._ios = [MachineIo(description, **options) for _ in range(num_envs)]
            self._seeds = [Seeds(description.seed + k) for k in range(num_envs)]
        except BaseException:
            self.session.close()
            raise
        self.num_envs = num_envs
        self._seed, self._over = [0] * num_envs, None
        self.single_action_space = self._ios[0].action_space
        self.single_observation_space = self._ios[0].observation_space
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_space = batch_space(self.single_observation_space, num_envs)

    @property
    def machine(self):
        """The description of the machine in the first environment."""
        return self._ios[0].machine

    def reset(self, *, seed=None, options=None):
        if options:
            raise ValueError(f"options of a reset: {', '.join(options)}; need none")
        if seed is None or isinstance(seed, (int, np.integer)):
            seed = [None if seed is None else int(seed) + k for k in range(self.num_envs)]
        if len(seed) != self.num_envs:
            raise ValueError(f"{len(seed)} seeds; need {self.num_envs}, one for each environment")
        told = self._ask([self._reset(k, seed[k]) for k in range(self.num_envs)])
        self._over = np.zeros(self.num_envs, bool)
        observations, infos, _ = zip(*told)
        return self._stacked(observations), self._stacked_infos(infos)

    def step(self, actions):
        if self._over is None:
            raise RuntimeError("step before reset; need env.reset() first")
        if len(actions) != self.num_envs:
            raise ValueError(f"{len(actions)} actions; need {self.num_envs}, one for each environment")
        begins = self._over
        # Steps before resets: a faulty action is refused before any seed is taken.
        steps = [None if begins[k] else self._step(k, actions[k]) for k in range(self.num_envs)]
        told = self._ask([self._reset(k, None) if begins[k] else steps[k] for k in range(self.num_envs)])
        rewards = np.zeros(self.num_envs)
        terminations, truncations = np.zeros(self.num_envs, bool), np.zeros(self.num_envs, bool)
        for k, (observation, info, truncated) in enumerate(told):
            if begins[k]:
                continue
            rewards[k] = self._reward(observation, info)
            terminations[k], truncations[k] = self._terminated(observation, info), truncated
        self._over = terminations | truncations
        observations, infos, _ = zip(*told)
        return self._stacked(observations), rewards, terminations, truncations, self._stacked_infos(infos)

    def close(self, **_):
        self.session.close()
        if self._server:
            self._server.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    # ---- Turns of a batch

    def _reset(self, k, seed):
        self._seed[k], following = self._seeds[k].begin(seed)
        self._ios[k].begin()
        return messages.Turn(environment=k, reset=messages.Reset(
            seed=self._seed[k], observe=self._ios[k].observe, next_seed=following if self._prepare else None))

    def _step(self, k, action):
        io = self._ios[k]
        return messages.Turn(environment=k, step=messages.Step(actions=[io.action(action)], duration_s=io.step_s,
                                                               observe=io.observe))

    def _ask(self, turns):
        """What is told of each environment. Raises Refused where one cannot do its turn, once all have been asked."""
        outcomes = self.session.batch(turns)
        for k, outcome in enumerate(outcomes):
            if isinstance(outcome, Refused):
                self._over = None
                raise Refused(f"environment {k}: {outcome}", outcome.episode_over)
            if outcome.described_anew:
                self._ios[k].redescribe(self.session.describe(k))
        return [io.told(told, seed) for io, told, seed in zip(self._ios, outcomes, self._seed)]

    def _stacked(self, observations):
        return {name: np.stack([observation[name] for observation in observations]) for name in observations[0]}

    def _stacked_infos(self, infos):
        truth = {name: np.array([info["truth"][name] for info in infos]) for name in infos[0]["truth"]}
        return {"time_s": truth["time_s"], "seed": np.array(self._seed), "truth": truth,
                "messages": [info["message"] for info in infos]}


def make_vector(scenario, num_envs, options=(), **env_options):
    """A VectorEnv with a server of its own, which ends with it. `options` go to `tera serve`, the others to Env."""
    return with_server(VectorEnv, scenario, options, {"num_envs": num_envs, **env_options})
