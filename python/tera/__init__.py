"""Steps a TERA simulation over a socket (docs/serve.md).

    import tera
    with tera.make("config/scenarios/quickstart.yaml") as env:
        obs, info = env.reset(seed=1)
        obs, reward, terminated, truncated, info = env.step(env.action_space.sample())

Env is the environment, Session the requests below it, Server the program that answers them.
"""

from tera.env import Env, Patch, make
from tera.server import Server
from tera.session import Refused, Session, SessionEnded
from tera.v1 import simulation_pb2 as messages

__all__ = ["Env", "Patch", "Refused", "Server", "Session", "SessionEnded", "make", "messages"]
