"""What scripts/said.sh says of a command that runs into a pipe."""

import pathlib
import subprocess
import unittest

_SAID = pathlib.Path(__file__).parents[2] / "scripts" / "said.sh"


def _run(commands: str) -> subprocess.CompletedProcess:
    return subprocess.run(["bash", "-euc", f". {_SAID}; said_every_s=1; {commands}"], capture_output=True, text=True, check=False)


class SaidTest(unittest.TestCase):
    def test_a_long_command_is_told_of_with_its_last_line(self):
        done = _run("said digging bash -c 'echo first; sleep 1.6; echo second; sleep 1'; echo end")
        lines = done.stdout.splitlines()
        self.assertEqual((lines[0], lines[-1], done.returncode), ("digging", "end", 0))
        self.assertEqual(lines[1], "digging: 1 s  first")
        self.assertIn("digging: 2 s  second", lines)

    def test_a_quick_one_says_its_name_alone(self):
        self.assertEqual(_run("said digging echo noise").stdout, "digging\n")

    def test_one_that_fails_ends_the_script_with_what_it_said(self):
        done = _run("said digging bash -c 'echo it broke; exit 7'; echo end")
        self.assertEqual((done.returncode, done.stdout), (7, "digging\n"))
        self.assertEqual(done.stderr, "it broke\n")


if __name__ == "__main__":
    unittest.main()
