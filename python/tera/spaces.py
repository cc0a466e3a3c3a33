"""Gymnasium's Box and Dict, or their like where Gymnasium is not installed."""

import numpy as np

try:
    from gymnasium import Env as EnvBase
    from gymnasium.spaces import Box, Dict
    from gymnasium.vector import AutoresetMode
    from gymnasium.vector import VectorEnv as VectorBase
    from gymnasium.vector.utils import batch_space
    NEXT_STEP = AutoresetMode.NEXT_STEP
except ImportError:
    EnvBase = VectorBase = object
    NEXT_STEP = "NextStep"

    class Box:
        """Arrays of one shape and type between two bounds, the bounds included."""

        def __init__(self, low, high, shape=None, dtype=np.float32):
            self.dtype = np.dtype(dtype)
            self.shape = np.broadcast(low, high).shape if shape is None else tuple(shape)
            self.low = np.full(self.shape, low, self.dtype)
            self.high = np.full(self.shape, high, self.dtype)
            self.seed()

        def seed(self, seed=None):
            self._random = np.random.default_rng(seed)

        def sample(self):
            """Uniform between finite bounds, normal about 0 where one is infinite."""
            bounded = np.isfinite(self.low) & np.isfinite(self.high)
            with np.errstate(invalid="ignore"):
                low = np.where(bounded, self.low, 0.0)
                span = np.where(bounded, self.high - low, 0.0)
            if self.dtype.kind in "iu":
                return self._random.integers(self.low, self.high, self.shape, self.dtype, endpoint=True)
            uniform = low + span * self._random.random(self.shape)
            normal = np.clip(self._random.standard_normal(self.shape), self.low, self.high)
            return np.where(bounded, uniform, normal).astype(self.dtype)

        def contains(self, x):
            x = np.asarray(x)
            return bool(x.shape == self.shape and np.can_cast(x.dtype, self.dtype) and np.all(x >= self.low)
                        and np.all(x <= self.high))

        __contains__ = contains

        def __repr__(self):
            return f"Box(shape={self.shape}, dtype={self.dtype})"

    class Dict:
        """A mapping from names to spaces."""

        def __init__(self, spaces):
            self.spaces = dict(spaces)

        def __getitem__(self, name):
            return self.spaces[name]

        def __iter__(self):
            return iter(self.spaces)

        def keys(self):
            return self.spaces.keys()

        def items(self):
            return self.spaces.items()

        def seed(self, seed=None):
            for space in self.spaces.values():
                space.seed(seed)

        def sample(self):
            return {name: space.sample() for name, space in self.spaces.items()}

        def contains(self, x):
            return x.keys() == self.spaces.keys() and all(x[name] in space for name, space in self.spaces.items())

        __contains__ = contains

        def __repr__(self):
            return f"Dict({self.spaces})"

    def batch_space(space, count):
        """That of `count` arrays of `space`, or dicts of arrays, on top of each other."""
        if isinstance(space, Dict):
            return Dict({name: batch_space(part, count) for name, part in space.items()})
        return Box(np.stack([space.low] * count), np.stack([space.high] * count), dtype=space.dtype)
