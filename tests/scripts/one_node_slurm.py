"""A real Slurm on this machine alone: munged, slurmctld and slurmd of Debian's slurm-wlm and munge, on loopback, in a folder of its own.

    with OneNodeSlurm(folder) as slurm:
        slurm.run("sbatch", "job.sh")

Needs root. Its daemons are ended by their ids when the block ends.
"""
import os
import pathlib
import shutil
import socket
import subprocess
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "squeue", "scancel")
CONF = """ClusterName=titin
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
SlurmdPort={port_of_node}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
SlurmUser=root
SlurmdUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
MpiDefault=none
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
SchedulerParameters=sched_interval=5,batch_sched_delay=0
ReturnToService=2
KillWait=10
JobRequeue=1
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def missing():
    """Programs that are not here; empty when a Slurm can be started."""
    return [p for p in PROGRAMS if not shutil.which(p, path=os.environ["PATH"] + ":/usr/sbin:/sbin")] or ([] if os.getuid() == 0 else ["root"])


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


class OneNodeSlurm:
    def __init__(self, folder, cpus=2):
        self.folder, self.daemons = pathlib.Path(folder), []
        for name in ("munge", "state", "spool"):
            (self.folder / name).mkdir(mode=0o755)
        self.host = socket.gethostname().split(".")[0]
        conf = self.folder / "slurm.conf"
        conf.write_text(CONF.format(host=self.host, port=free_port(), port_of_node=free_port(), folder=self.folder, cpus=cpus))
        self.environment = {**os.environ, "SLURM_CONF": str(conf), "PATH": os.environ["PATH"] + ":/usr/sbin:/sbin"}

    def __enter__(self):
        key = self.folder / "munge" / "key"
        key.touch(mode=0o600)
        key.write_bytes(os.urandom(1024))
        at = self.folder / "munge"
        self.start("munged", "--foreground", "--force", f"--key-file={key}", f"--socket={at}/socket", f"--pid-file={at}/pid",
                   f"--log-file={at}/log", f"--seed-file={at}/seed")  # fmt: skip
        self.wait_for(lambda: (at / "socket").exists(), "munged", 10)
        self.start("slurmctld", "-D")
        self.start("slurmd", "-D", "-N", self.host)
        self.wait_for(lambda: "idle" in self.run("sinfo", "-h", "-o", "%T").stdout, "the node", 60)
        return self

    def start(self, *command):
        log = open(self.folder / f"{command[0]}.out", "w")
        self.daemons.append(subprocess.Popen(command, env=self.environment, stdout=log, stderr=log, stdin=subprocess.DEVNULL))

    def __exit__(self, *_):
        self.run("scancel", "--full", "--me")
        time.sleep(1)
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in self.daemons:
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()

    def run(self, *command, **options):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, **options)

    @staticmethod
    def wait_for(is_so, what, seconds):
        end = time.monotonic() + seconds
        while not is_so():
            if time.monotonic() > end:
                raise TimeoutError(f"{what} did not come within {seconds} s")
            time.sleep(0.5)

    def wait_for_job(self, number, seconds):
        """Until the queue no longer knows it, or knows it as ended."""
        self.wait_for(lambda: not self.run("squeue", "-h", "-j", number, "-t", "PD,R,CG,CF,S,RQ").stdout.strip(), f"job {number}", seconds)
