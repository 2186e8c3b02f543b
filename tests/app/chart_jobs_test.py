"""Shards of a chart as jobs: under GNU parallel, and as a job array of a real Slurm of one node; one that dies is named.

Both are optional packages (parallel; slurmctld, slurmd, slurm-client and munge): where they are absent the tests skip."""

import os
import re
import shlex
import shutil
import socket
import subprocess
import time
import unittest

from chart_command_test import VALUES, Chart
from program import PROGRAM

SLURM = ("munged", "slurmctld", "slurmd", "sbatch", "sinfo")


def missing(*programs):
    path = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
    return [name for name in programs if not shutil.which(name, path=path)]


class Jobs(Chart):
    def command(self, shard, shards, output):
        whole = shlex.join(map(str, [PROGRAM, *self.arguments(output)[:-2]]))
        return f"{whole} --shard {shard}/{shards} -o {output}"  # as a shell is to read it

    def run_jobs(self, command, **more):
        return subprocess.run(command, env=dict(self.environment(), **more), cwd=self.out, capture_output=True, text=True,
                              timeout=240)

    def merge(self, *parts):
        return self.run_program("chart", "--merge", *parts, "-o", "whole")


class DeadShards(Jobs):
    def test_one_that_was_killed_is_named_and_goes_on(self):
        self.assert_good(self.run_program(*self.arguments("part1", "--shard", "1/2")))
        process = self.start_program(*self.arguments("part0", "--shard", "0/2"))
        deadline = time.monotonic() + 60
        while not list(self.out.glob("part0/points/*.json")):
            self.assertLess(time.monotonic(), deadline, (self.folder / "said").read_text())
            time.sleep(0.005)
        self.stop(process)
        result = self.merge("part0", "part1")
        self.assertEqual(result.returncode, 2, result.stdout)
        self.assertRegex(result.stderr, r"shard 0/2 did not end: 1 of its 2 points are missing, the first is '\S+tiny\.json.*"
                                        r"--shard 0/2 -o part0")
        self.assertNotIn("shard 1/2", result.stderr)
        self.assertEqual(len(self.rows("whole")), 3, "what there is is joined")
        self.assert_good(self.run_program(*self.arguments("part0", "--shard", "0/2")))
        self.assert_good(self.merge("part0", "part1"))
        self.assertEqual(self.values("whole"), VALUES)

    def test_one_that_left_nothing_is_named(self):
        self.assert_good(self.run_program(*self.arguments("part0", "--shard", "0/3")))
        self.assert_good(self.run_program(*self.arguments("part2", "--shard", "2/3")))
        result = self.merge("part0", "part2")
        self.assertEqual(result.returncode, 2, result.stdout)
        self.assertIn("shard 1/3 left nothing", result.stderr)
        self.assertEqual(len(re.findall("shard ", result.stderr)), 2, "the name, and the option that measures it")

    def test_what_a_shard_could_not_measure_is_named(self):
        self.sweep.write_text('{"lists": {"shadow_maps.resolution": [32, 1]}}')
        self.assert_good(self.run_program(*self.arguments("part0", "--shard", "0/2")))
        self.assertEqual(self.run_program(*self.arguments("part1", "--shard", "1/2")).returncode, 2)
        result = self.merge("part0", "part1")
        self.assertEqual(result.returncode, 2, result.stdout)
        self.assertRegex(result.stderr, r"shard 1/2 could not measure .*shadow_maps\.resolution=1: ")

    def test_a_damaged_record_is_refused(self):
        self.assert_good(self.run_program(*self.arguments("part0", "--shard", "0/1")))
        record = self.out / "part0/shards/0-of-1.json"
        record.write_text(record.read_text().replace('"shard": 0', '"shard": 7'))
        self.assertIn("not a shard of a chart", self.merge("part0").stderr)


@unittest.skipIf(missing("parallel"), "GNU parallel is not installed (the Debian package parallel)")
class Parallel(Jobs):
    def test_parts_join_to_the_whole(self):
        jobs = self.run_jobs(["parallel", "--will-cite", "-j", "2", self.command("{}", 3, "parts/{}"), ":::", "0", "1", "2"],
                             HOME=str(self.folder))
        self.assertEqual(jobs.returncode, 0, jobs.stdout + jobs.stderr)
        self.assert_good(self.merge("parts/0", "parts/1", "parts/2"))
        self.assertEqual(self.values("whole"), VALUES)
        self.assert_good(self.run_program(*self.arguments("alone")))
        self.assertEqual(set(self.point_files("whole")), set(self.point_files("alone")), "the same points as one run's")


@unittest.skipIf(missing(*SLURM), "Slurm is not installed (the Debian packages slurmctld, slurmd, slurm-client and munge)")
@unittest.skipUnless(os.geteuid() == 0, "only root can start a Slurm of its own")
class Slurm(Jobs):
    """A controller, a node and their keys, on this machine and for this test."""

    def setUp(self):
        super().setUp()
        own = self.folder / "slurm"
        for folder in (own / "state", own / "spool"):
            folder.mkdir(parents=True)
        own.chmod(0o700)
        (own / "key").write_bytes(os.urandom(1024))
        (own / "key").chmod(0o600)
        self.host = socket.gethostname().split(".")[0]
        ports = []
        for _ in range(2):
            with socket.socket() as free:
                free.bind(("127.0.0.1", 0))
                ports.append(free.getsockname()[1])
        config = own / "slurm.conf"
        config.write_text(f"""ClusterName=test
SlurmctldHost={self.host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={own}/munge.sock
CredType=cred/munge
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
StateSaveLocation={own}/state
SlurmdSpoolDir={own}/spool
SlurmctldPidFile={own}/slurmctld.pid
SlurmdPidFile={own}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
NodeName={self.host} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
""")
        self.config = {"SLURM_CONF": str(config), "PATH": os.environ["PATH"] + ":/usr/sbin:/sbin"}
        self.log = own / "log"
        self.daemon("munged", "--foreground", "--force", f"--key-file={own}/key", f"--socket={own}/munge.sock",
                    f"--pid-file={own}/munge.pid", f"--log-file={own}/munge.log", f"--seed-file={own}/seed")
        self.until(lambda: (own / "munge.sock").exists())
        self.daemon("slurmctld", "-D", "-f", str(config))
        self.daemon("slurmd", "-D", "-f", str(config), "-N", self.host)
        self.until(lambda: "idle" in self.run_jobs(["sinfo", "-h", "-o", "%t"], **self.config).stdout)

    def daemon(self, *command):
        with open(self.log, "a") as log:
            process = subprocess.Popen(command, env=dict(os.environ, **self.config), stdout=log, stderr=log)
        self.addCleanup(self.stop, process)

    def until(self, there):
        deadline = time.monotonic() + 60
        while not there():
            self.assertLess(time.monotonic(), deadline, self.log.read_text())
            time.sleep(0.1)

    def submit(self, array, script):
        job = self.run_jobs(["sbatch", "--wait", f"--array={array}", "-o", "job%a.txt", "--wrap", script], **self.config)
        said = {path.name: path.read_text() for path in self.out.glob("job*.txt")}
        return job.returncode, f"{job.stdout}{job.stderr}{said}"

    def test_a_job_array_and_a_task_of_it_that_dies(self):
        command = self.command("$SLURM_ARRAY_TASK_ID", 3, "parts/$SLURM_ARRAY_TASK_ID")
        code, said = self.submit("0-2", f"if [ $SLURM_ARRAY_TASK_ID = 1 ]; then kill -KILL $$; fi; {command}")
        self.assertNotEqual(code, 0, "Slurm tells that a task was killed")
        self.assertTrue((self.out / "parts/2/chart.csv").is_file(), said)
        result = self.merge("parts/0", "parts/2")
        self.assertEqual(result.returncode, 2, result.stdout)
        self.assertIn("shard 1/3 left nothing", result.stderr)
        code, said = self.submit("1", command)
        self.assertEqual(code, 0, said)
        self.assert_good(self.merge("parts/0", "parts/1", "parts/2"))
        self.assertEqual(self.values("whole"), VALUES)


del Chart, Jobs  # bases, which hold no tests of their own

if __name__ == "__main__":
    unittest.main()
