"""Requests and responses of one session, as messages."""

import queue

import grpc

from tera.v1 import simulation_pb2 as messages
from tera.v1 import simulation_pb2_grpc as service

PROTOCOL = 1

# Answers may hold many pictures; the server bounds them. A proxy has no part in talking to a neighbour. Each session
# has a connection of its own: a shared one could be that to an earlier server, since ended, on the same port.
_CHANNEL_OPTIONS = [
    ("grpc.max_receive_message_length", -1),
    ("grpc.enable_http_proxy", 0),
    ("grpc.use_local_subchannel_pool", 1),
]


class Refused(Exception):
    """The server cannot do what was asked; the session goes on.

    Nothing has changed, unless `episode_over`: a fault ended the episode, and a reset begins the next.
    """

    def __init__(self, message, episode_over=False):
        super().__init__(message)
        self.episode_over = episode_over


class SessionEnded(ConnectionError):
    """There is no session (any more). `code` is a grpc.StatusCode."""

    def __init__(self, code, message):
        super().__init__(f"{message} ({code.name})")
        self.code = code


class Session:
    """One session with a server at `address`, "127.0.0.1:50051".

    `description` is what the server simulates. Raises SessionEnded where the server cannot be reached within
    `timeout_s` or is busy with another client (code RESOURCE_EXHAUSTED).
    """

    def __init__(self, address, client="python", timeout_s=10.0):
        self._channel = grpc.insecure_channel(address, options=_CHANNEL_OPTIONS)
        try:
            grpc.channel_ready_future(self._channel).result(timeout=timeout_s)
        except grpc.FutureTimeoutError:
            self._channel.close()
            raise SessionEnded(grpc.StatusCode.UNAVAILABLE, f"no server answers at {address}") from None
        self._requests = queue.SimpleQueue()
        self._sequence = 0
        self._waiting = False
        self._responses = service.SimulationStub(self._channel).Session(iter(self._requests.get, None))
        try:
            self.welcome = self.ask(hello=messages.Hello(protocol=PROTOCOL, client=client)).welcome
            self.description = self.describe()
        except BaseException:
            self.close()
            raise

    def ask(self, **kind):
        """The response to a request of the given kind: `ask(step=messages.Step(physics_steps=5))`."""
        self._sequence += 1
        self._requests.put(messages.Request(sequence=self._sequence, **kind))
        self._waiting = True
        try:
            response = next(self._responses)
        except StopIteration:
            raise SessionEnded(grpc.StatusCode.OK, "the session is closed") from None
        except grpc.RpcError as error:
            raise SessionEnded(error.code(), error.details()) from None
        except BaseException:  # Ctrl-C: its answer would be taken for that of the next request
            self._responses.cancel()
            raise
        if response.sequence != self._sequence:
            self._responses.cancel()
            raise SessionEnded(grpc.StatusCode.INTERNAL, f"answer {response.sequence} to request {self._sequence}; "
                               "need one answer to each request, in their order")
        self._waiting = False
        if response.WhichOneof("kind") == "refusal":
            raise Refused(response.refusal.message, response.refusal.episode_over)
        return response

    def describe(self, environment=0):
        """What is simulated, as the episode of that environment has drawn it."""
        return self.ask(describe=messages.Describe(environment=environment)).description

    def reset(self, seed=None, observe=None, next_seed=None):
        """A fresh episode; an Observation at t = 0. `next_seed`: that of the reset to follow, which is then prepared."""
        return self.ask(reset=messages.Reset(seed=seed, observe=observe, next_seed=next_seed)).observation

    def step(self, actions=(), duration_s=None, physics_steps=None, observe=None):
        """An Observation after the given duration, or number of physics steps, under `actions`."""
        return self.ask(step=messages.Step(actions=actions, duration_s=duration_s, physics_steps=physics_steps,
                                           observe=observe)).observation

    def batch(self, turns):
        """An Observation for each of the turns (messages.Turn), or the exception Refused for one that cannot be done."""
        outcomes = self.ask(batch=messages.Batch(turns=turns)).outcomes.outcomes
        return [outcome.observation if outcome.HasField("observation")
                else Refused(outcome.refusal.message, outcome.refusal.episode_over) for outcome in outcomes]

    def close(self):
        """Ends the session and waits until the server is free for the next."""
        self._requests.put(None)
        if self._waiting:
            self._responses.cancel()
        try:
            for _ in self._responses:
                pass
        except grpc.RpcError:
            pass  # it had ended already
        self._channel.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
