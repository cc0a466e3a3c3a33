"""Two nodes of a real Slurm on this computer make a campaign of 24 episodes; a node is killed while they do, and the controller is
restarted. All episodes come out with the digests that the local pool gives.

    slurm_test.py TERA      exit status 77 where Slurm cannot run here
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SKIPPED = 77
PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "unshare")
SCENARIO = """name: resting
seed: 5
duration_s: 2
settle_s: 0.1
terrain: {size_m: [14, 14], cell_m: 0.1, soils: [dirt, sand], soil: dirt}
machines:
  - name: rover1
    machine: tera:config/machines/warthog.yaml
    operator: {type: idle}
    rig: {sensors: [
      {name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, link: chassis, rate_hz: 100}]}
randomise:
  - {key: environment.sun_elevation_deg, uniform: [10, 60]}
"""
CAMPAIGN = """name: soils
scenario: resting.yaml
episodes: 24
factors:
  - {key: terrain.soil, levels: [dirt, sand]}
"""
CONFIG = """ClusterName=loopback
SlurmctldHost=localhost(127.0.0.1)
SlurmUser=root
SlurmctldPort={port}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool.%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SlurmdTimeout=6
MessageTimeout=3
ReturnToService=1
SchedulerParameters=sched_interval=1,batch_sched_delay=0
NodeName=one NodeHostname=localhost NodeAddr=127.0.0.1 Port={one} CPUs=1
NodeName=two NodeHostname=localhost NodeAddr=127.0.0.1 Port={two} CPUs=1
PartitionName=all Nodes=one,two Default=YES State=UP
"""


def wait_for(condition, what, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError(what)
        time.sleep(0.2)


class Cluster:
    """munge, a controller and two nodes, each node in a PID namespace of its own, so that it can be killed with all it runs."""

    def __init__(self, folder: Path):
        self.folder, self.running = folder, {}
        (folder / "state").mkdir()
        port = 20000 + os.getpid() % 20000
        config = folder / "slurm.conf"
        config.write_text(CONFIG.format(folder=folder, port=port, one=port + 1, two=port + 2))
        self.environment = {**os.environ, "SLURM_CONF": str(config)}

    def begin(self):
        folder = self.folder
        (folder / "munge.key").write_bytes(os.urandom(1024))
        (folder / "munge.key").chmod(0o400)
        self.start("munged", "munged", "--foreground", "--force", f"--socket={folder}/munge.socket", f"--key-file={folder}/munge.key",
                   f"--pid-file={folder}/munge.pid", f"--log-file={folder}/munge.log", f"--seed-file={folder}/munge.seed")
        wait_for((folder / "munge.socket").exists, "munge")
        self.start("controller", "slurmctld", "-D")
        for node in ("one", "two"):
            (folder / f"spool.{node}").mkdir()
            self.start(node, "unshare", "--pid", "--fork", "--kill-child", "--mount-proc", "slurmd", "-D", "-N", node)
        wait_for(lambda: self.ask("scontrol", "show", "nodes").count("State=IDLE") == 2, "two idle nodes")

    def start(self, name, *command):
        with open(self.folder / f"{name}.out", "ab") as out:
            self.running[name] = subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=out, stderr=out)

    def kill(self, name):
        self.running[name].kill()
        self.running.pop(name).wait()

    def restart_controller(self):
        self.running["controller"].terminate()  # it saves its state, and forgets no task that began
        self.running.pop("controller").wait()
        time.sleep(2)
        self.start("controller", "slurmctld", "-D")

    def ask(self, *command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, check=False).stdout

    def last_words(self):
        return "\n".join(f"{out.name}: {out.read_text()[-300:]}" for out in sorted(self.folder.glob("*.out")))

    def end(self):
        for name in reversed(list(self.running)):
            self.kill(name)


def digests(folder: Path) -> dict:
    return {f.parent.name: re.search(r"sha256: (.*)", f.read_text())[1] for f in sorted(folder.glob("episodes/*/episode.yaml"))}


def run(tera: str, scratch: Path, cluster: Cluster) -> None:
    (scratch / "resting.yaml").write_text(SCENARIO)
    (scratch / "campaign.yaml").write_text(CAMPAIGN)
    for folder in ("pool", "slurm"):
        subprocess.run([tera, "campaign", "plan", "campaign.yaml", "--out", folder], cwd=scratch, check=True)
    subprocess.run([tera, "campaign", "run", "pool"], cwd=scratch, check=True)
    campaign = subprocess.Popen([tera, "campaign", "run", "slurm", "--on", "slurm", "--per-task", "2", "--poll", "1"],
                                cwd=scratch, env=cluster.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    cluster.running["campaign"] = campaign
    wait_for(lambda: len(digests(scratch / "slurm")) >= 4, "four episodes", 120)
    wait_for(lambda: "two" in cluster.ask("squeue", "-h", "-t", "running", "-o", "%N"), "a task on node two")
    cluster.kill("two")
    cluster.restart_controller()
    said, _ = campaign.communicate(timeout=600)
    print(said)
    assert campaign.returncode == 0, campaign.returncode
    assert "NODE_FAIL" in said, "a task was lost with its node"
    assert digests(scratch / "slurm") == digests(scratch / "pool"), "episodes differ"
    assert len(digests(scratch / "pool")) == 24


def main() -> int:
    os.environ["PATH"] += ":/usr/sbin:/sbin"
    missing = [program for program in PROGRAMS if not shutil.which(program)]
    if missing or subprocess.run(["unshare", "--pid", "--fork", "--mount-proc", "true"], check=False, capture_output=True).returncode != 0:
        print("skipped: needs", ", ".join(missing) or "the right to make namespaces")
        return SKIPPED
    with tempfile.TemporaryDirectory(prefix="tera_slurm_", ignore_cleanup_errors=True) as folder:
        cluster = Cluster(Path(folder))
        try:
            try:
                cluster.begin()
            except TimeoutError as late:
                print(f"skipped: Slurm does not start here ({late}):", cluster.last_words())
                return SKIPPED
            run(str(Path(sys.argv[1]).resolve()), Path(folder), cluster)
        finally:
            cluster.end()
    return 0


if __name__ == "__main__":
    sys.exit(main())
