"""What scripts/said.sh says of a command that runs into a pipe."""

import pathlib
import subprocess
import tempfile
import unittest

_SAID = pathlib.Path(__file__).parents[2] / "scripts" / "said.sh"


def _run(commands: str) -> subprocess.CompletedProcess:
    return subprocess.run(["bash", "-euc", f". {_SAID}; said_every_s=1; {commands}"], capture_output=True, text=True, check=False)


class SaidTest(unittest.TestCase):
    def test_a_long_command_is_told_of_with_its_last_line(self):
        # The command says its second line when the first has been told of, and ends when the second has: its pace is not the clock's.
        with tempfile.TemporaryDirectory() as folder:
            told = pathlib.Path(folder) / "told"
            command = f"echo first; until grep -q first {told}; do sleep 0.1; done; echo second; until grep -q second {told}; do sleep 0.1; done"
            done = _run(f"{{ said digging bash -c '{command}'; echo end; }} | tee {told}")
        lines = done.stdout.splitlines()
        self.assertEqual((lines[0], lines[-1], done.returncode), ("digging", "end", 0))
        self.assertRegex(lines[1], r"^digging: [1-9]\d* s  first$")
        self.assertRegex(lines[-2], r"^digging: [1-9]\d* s  second$")

    def test_a_quick_one_says_its_name_alone(self):
        self.assertEqual(_run("said digging echo noise").stdout, "digging\n")

    def test_one_that_fails_ends_the_script_with_what_it_said(self):
        done = _run("said digging bash -c 'echo it broke; exit 7'; echo end")
        self.assertEqual((done.returncode, done.stdout), (7, "digging\n"))
        self.assertEqual(done.stderr, "it broke\n")


if __name__ == "__main__":
    unittest.main()
