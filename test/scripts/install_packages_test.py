"""scripts/install_packages.sh beside another apt, with an apt-get that is made up here."""

import os
import pathlib
import subprocess
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).parents[2] / "scripts/install_packages.sh"
LOCKED = ("E: Could not get lock /var/lib/apt/lists/lock. It is held by process 4711 (apt-get)\\n"
          "E: Unable to lock directory /var/lib/apt/lists/")


class InstallPackages(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.bin = pathlib.Path(self.folder.name)
        self.calls = self.bin / "calls"
        self.program("dpkg-query", '[ "${@: -1}" = there ] && echo installed; exit 0')
        self.program("sudo", 'exec "$@"')

    def tearDown(self):
        self.folder.cleanup()

    def program(self, name, body):
        file = self.bin / name
        file.write_text("#!/bin/bash\n" + body + "\n")
        file.chmod(0o755)

    def install(self, *packages):
        return subprocess.run([SCRIPT, *packages], capture_output=True, text=True, check=False,
                              env={**os.environ, "PATH": f"{self.bin}:{os.environ['PATH']}", "TERA_APT_PAUSE_S": "0"})

    def test_installs_only_what_is_missing(self):
        self.program("apt-get", f'echo "$*" >>{self.calls}')
        self.assertEqual(self.install("there", "absent").returncode, 0)
        calls = self.calls.read_text().splitlines()
        self.assertEqual(len(calls), 2)
        self.assertIn("update", calls[0])
        self.assertTrue(calls[1].endswith("install -y --no-install-recommends absent"), calls[1])

    def test_calls_no_apt_where_all_is_there(self):
        self.program("apt-get", f'echo "$*" >>{self.calls}')
        self.assertEqual(self.install("there").returncode, 0)
        self.assertFalse(self.calls.exists())

    def test_waits_for_the_lock_that_another_apt_holds_and_says_so(self):
        self.program("apt-get", f'echo "$*" >>{self.calls}; '
                                f'[ $(wc -l <{self.calls}) -gt 2 ] || {{ printf "{LOCKED}" >&2; exit 100; }}')
        run = self.install("absent")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(len(self.calls.read_text().splitlines()), 4)
        self.assertEqual(run.stdout.count("held by process 4711"), 2)

    def test_another_failure_ends_it_at_once_with_what_apt_said(self):
        self.program("apt-get", f'echo "$*" >>{self.calls}; echo "E: Unable to locate package absent" >&2; exit 100')
        run = self.install("absent")
        self.assertEqual(run.returncode, 1)
        self.assertEqual(len(self.calls.read_text().splitlines()), 1)
        self.assertIn("Unable to locate package absent", run.stderr)


if __name__ == "__main__":
    unittest.main()
