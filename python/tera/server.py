"""A `tera serve` of one's own."""

import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path


def find_program():
    """The `tera` named by TERA_PROGRAM, else of the build or installation this package lies in, else on the path."""
    if "TERA_PROGRAM" in os.environ:
        return os.environ["TERA_PROGRAM"]
    package = Path(__file__).resolve().parent
    for beside in (package.parents[1] / "tera", package.parents[3] / "bin" / "tera"):
        if beside.is_file() and os.access(beside, os.X_OK):
            return str(beside)
    found = shutil.which("tera")
    if found is None:
        raise FileNotFoundError("no program 'tera': name it in TERA_PROGRAM, or build it with scripts/quickstart.sh")
    return found


class Server:
    """`tera serve` as a child of this process, on a port that the system chooses; `address` is for Session and Env.

    `options` are further arguments of the command, such as "--record", "out/episodes". Raises RuntimeError with what
    the program said where it does not come up.
    """

    def __init__(self, scenario, options=(), program=None):
        command = [program or find_program(), "serve", str(scenario), "--port", "0", *map(str, options)]
        self._log = tempfile.NamedTemporaryFile(prefix="tera_serve_")
        self._process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=self._log,
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
        self._process.stdout.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
