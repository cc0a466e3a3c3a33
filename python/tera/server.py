"""A `tera serve` of one's own."""

import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path


_PACKAGE = Path(__file__).resolve().parent


def find_program():
    """The `tera` named by TERA_PROGRAM, else of the build or installation this is part of, else on the path."""
    named = os.environ.get("TERA_PROGRAM")
    if named is not None:
        if not _is_program(Path(named)):
            raise FileNotFoundError(f"TERA_PROGRAM names {named}, which is no program; need the path of 'tera'")
        return named
    beside = _beside()
    if beside is not None and _is_program(beside):
        return str(beside)
    found = shutil.which("tera")
    if found is None:
        missing = f"not at {beside}, " if beside else ""
        raise FileNotFoundError(f"no program 'tera': {missing}not on the PATH; name it in TERA_PROGRAM, or build it "
                                "with scripts/quickstart.sh")
    return found


def _beside():
    """Where the program of the same build or installation is, or None for a package that was copied elsewhere."""
    folders = _PACKAGE.parts
    if folders[-4:-1] == ("share", "tera", "python"):  # PREFIX/share/tera/python/tera
        return _PACKAGE.parents[3] / "bin" / "tera"
    if folders[-2:-1] == ("python",):  # BUILD/python/tera
        return _PACKAGE.parents[1] / "tera"
    return None


def _is_program(path):
    return path.is_file() and os.access(path, os.X_OK)


class Server:
    """`tera serve` as a child of this process, on a port that the system chooses; `address` is for Session and Env.

    It ends with close, or with this process, however that ends. `options` are further arguments of the command, such as
    "--record", "out/episodes". Raises RuntimeError with what the program said where it does not come up.
    """

    def __init__(self, scenario, options=(), program=None):
        command = [program or find_program(), "serve", str(scenario), "--port", "0", "--stop-with-stdin",
                   *map(str, options)]
        self._log = tempfile.NamedTemporaryFile(prefix="tera_serve_")
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._log,
                                         text=True)
        first_line = self._process.stdout.readline()
        match = re.fullmatch(r"serving .* on (\S+)\n", first_line)
        if match is None:
            self.close()
            raise RuntimeError(f"{' '.join(command)}\n{first_line}{self.said()}")
        self.address = match[1]

    def said(self):
        """What the program wrote on its standard error: a line for each session's beginning and end."""
        return Path(self._log.name).read_text()

    def close(self):
        """Stops the server; an episode under way is ended, its recording finished."""
        self._process.terminate()
        self._process.wait()
        self._process.stdin.close()
        self._process.stdout.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
