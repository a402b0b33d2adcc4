"""tools/workflow: collections by Snakemake, on the cores of this machine."""

import os
import pathlib
import shutil
import signal
import subprocess
import sys
import unittest
import warnings

from support import OCTAHEDRON, PROGRAM, SAMPLES, SCHEMA, ProgramTest, until

WORKFLOW = SCHEMA.parent.parent / "workflow"
SNAKEMAKE = "/usr/bin/snakemake"  # Debian's, whatever is first on the PATH
QUICK = ("--method", "conventional", "--method", "salient:iterations=2", "--no-thumbnails")
# on all meshes but the octahedron long enough to be found at work
SLOW = ("--method", "conventional", "--method", "salient:iterations=1500", "--no-thumbnails")
LONG = ("--method", "salient:iterations=1000000", "--no-thumbnails")  # hours
LIMITS = ("--time-limit", "3600", "--memory-limit", "1000000000")  # the sanitizers' builds need address space

sys.path.insert(0, str(WORKFLOW))
sys.dont_write_bytecode = True
with warnings.catch_warnings():
    warnings.simplefilter("ignore", DeprecationWarning)  # of Snakemake's own
    import planning
    from snakemake.exceptions import WorkflowError


class WorkflowTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.meshes = self.folder / "meshes"
        (self.meshes / "deeper").mkdir(parents=True)
        self.file("meshes/octahedron.off", OCTAHEDRON)
        shutil.copy(SAMPLES / "sphere.off", self.meshes)
        shutil.copy(SAMPLES / "anchor.off", self.meshes / "deeper" / "an anchor.off")
        self.out = self.folder / "out"

    def command(self, *settings, options=QUICK, snakemake=(), collection="meshes"):
        return [SNAKEMAKE, "--snakefile", WORKFLOW / "Snakefile", "--profile",
                WORKFLOW / "profiles" / "local", "--cores", "2",
                *snakemake, "--config", f"collection={collection}", "out=out", f"options={' '.join(options)}",
                f"morsel={PROGRAM}", f"memory_limit={LIMITS[-1]}", *settings]

    def workflow(self, *settings, code=0, **more):
        """Runs the workflow; what it says."""
        result = subprocess.run(self.command(*settings, **more), cwd=self.folder, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, timeout=240, check=False)
        self.assertEqual(result.returncode, code, result.stdout)
        return result.stdout

    def parts(self, said):
        """The number of jobs with meshes, from Snakemake's table of what it is about to do."""
        rows = [line.split() for line in said.splitlines()]
        return next((int(row[1]) for row in rows if len(row) == 4 and row[0] == "part"), 0)

    def plain(self, *arguments, options=QUICK, collection="meshes"):
        """One plain run, with which the workflow's results are compared: the same arguments in another
        folder."""
        shutil.rmtree(self.folder / "plain", ignore_errors=True)
        (self.folder / "plain").mkdir()
        for name in ("meshes", "list"):
            (self.folder / "plain" / name).symlink_to(self.folder / name)
        subprocess.run([PROGRAM, "batch", collection, "--out", "out", "--quiet", *options, *LIMITS,
                        *arguments],
                       cwd=self.folder / "plain", capture_output=True, timeout=240, check=False)

    def assert_same_as_plain(self):
        result = subprocess.run([WORKFLOW / "same-results", self.out, self.folder / "plain/out"],
                                capture_output=True, text=True,
                                check=False)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def times(self):
        return {str(path.relative_to(self.out / "state")): path.stat().st_mtime_ns
                for path in (self.out / "state").rglob("*.json")}


class Results(WorkflowTest):
    def test_a_collection_is_done_once_and_as_by_a_plain_batch(self):
        said = self.workflow()
        self.assertEqual(self.parts(said), 2)  # one a core
        self.assertIn("3 meshes: 3 done, 0 failed", said)
        self.plain()
        self.assert_same_as_plain()

        before = self.times()
        self.assertEqual(self.parts(self.workflow()), 0)
        self.assertEqual(self.times(), before)
        self.assert_same_as_plain()

        (self.meshes / "a new one.off").write_text(OCTAHEDRON)
        (self.out / "reports/sphere.off.json").unlink()
        self.assertEqual(self.parts(self.workflow("meshes_per_job=1", "retry=true")), 2)
        now = self.times()
        self.assertEqual({name for name in now if now[name] != before.get(name)},
                         {"a new one.off.json", "sphere.off.json"})
        self.plain()
        self.assert_same_as_plain()
        self.assertEqual({path.name for path in self.folder.iterdir()},
                         {"meshes", "out", "plain", ".snakemake"})

    def test_a_mesh_that_fails_does_not_stop_the_others(self):
        self.file("meshes/damaged.off", "OFF\n3 1 0\nnothing\n")
        said = self.workflow(code=1)
        self.assertIn("4 meshes: 3 done, 1 failed", said)
        self.assertIn("not all meshes are done: out/summary.csv", said)
        self.assertNotIn("Trying to restart", said)
        self.plain()
        self.assert_same_as_plain()
        self.assertEqual(self.parts(self.workflow(code=1)), 0)
        self.assertEqual(self.parts(self.workflow("retry=true", code=1)), 1)
        self.assert_same_as_plain()

    def test_a_list_and_options_from_a_file(self):
        self.file("list", "# two\nmeshes/sphere.off\nmeshes/octahedron.off\n")
        self.file("values=a,b.txt", "".join(f"{i}\n" for i in range(6)))
        options = ("--field", "height:axis=x", "--method", "conventional", "--no-thumbnails")
        self.file("settings.yaml",
                  "options: [--field, 'height:axis=x', --method=conventional, --no-thumbnails]\n")
        command = [word for word in self.command(collection="list",
                                                 snakemake=("--configfile", "settings.yaml"))
                   if not str(word).startswith("options=")]
        subprocess.run(command, cwd=self.folder, check=True, capture_output=True, timeout=240)
        self.plain(options=options, collection="list")
        self.assert_same_as_plain()


class Interruptions(WorkflowTest):
    def workers(self):
        return [pid for pid in os.listdir("/proc") if pid.isdigit() and self.is_worker(pid)]

    def is_worker(self, pid):
        """Whether a process of the program is at work in our folder."""
        try:
            words = pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().split(b"\0")
            return (words[1:2] in ([b"batch"], [b"compare"])
                    and os.readlink(f"/proc/{pid}/cwd") == str(self.folder.resolve())
                    and ") Z " not in pathlib.Path(f"/proc/{pid}/stat").read_text())
        except OSError:
            return False

    def test_a_run_that_is_ended_in_any_way_can_be_completed(self):
        self.plain(options=SLOW)
        for how in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            shutil.rmtree(self.out, ignore_errors=True)
            with subprocess.Popen(self.command(options=SLOW, snakemake=("--cores", "1")), cwd=self.folder,
                                  text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  start_new_session=True) as process:
                until(lambda: (self.out / "state/deeper/an anchor.off.json").exists() and self.workers())
                if how == signal.SIGINT:
                    os.killpg(process.pid, how)  # as Ctrl-C does
                else:
                    process.send_signal(how)
                process.communicate(timeout=60)
            self.assertNotEqual(process.returncode, 0)
            until(lambda: not self.workers(), 10)
            self.assertFalse((self.out / "summary.csv").exists())
            before = self.times()
            self.assertEqual("sphere.off.json" in before, how == signal.SIGTERM)  # which lets jobs end
            said = self.workflow(options=SLOW)
            self.assertIn("3 meshes: 3 done, 0 failed", said)
            self.assertEqual({name: time for name, time in self.times().items() if name in before}, before)
            self.assert_same_as_plain()

    def test_two_runs_are_independent(self):
        with subprocess.Popen(self.command(options=LONG), cwd=self.folder, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, start_new_session=True) as process:
            until(self.workers)
            self.assertIn("another run of this workflow is at work on out",
                          self.workflow(options=LONG, code=1))
            os.killpg(process.pid, signal.SIGINT)
            process.communicate(timeout=60)
        until(lambda: not self.workers(), 10)


class WrongInput(WorkflowTest):
    def test_what_cannot_begin_is_refused_in_one_sentence(self):
        (self.folder / "empty").mkdir()
        for wrong, said in (("collection=absent", "absent"),
                            ("collection=empty",
                             "there is no mesh (.off, .obj, .ply, .stl) in the folder empty"),
                            ("morsel=/bin/false", "/bin/false ended with 1"),
                            ("morsel=absent", 'there is no program "absent"'),
                            ("options=--method nonsense", "nonsense"),
                            ("colection=meshes", 'there is no setting "colection"')):
            with self.subTest(wrong=wrong):
                output = self.workflow(wrong, code=1)
                self.assertIn(said, output)
                self.assertNotIn("Job stats", output)
                self.assertFalse((self.out / "state").exists())

    def test_settings_are_checked(self):
        right = {"collection": "meshes", "out": "out", "morsel": PROGRAM}
        planning.Settings(right)
        for wrong, said in (({"colection": "x"},
                             'there is no setting "colection"; there are collection, out, '),
                            ({"out": None}, 'the setting "out" is missing'),
                            ({"options": "'"}, '"options" must be words'),
                            ({"options": {"a": "b"}}, '"options" must be words'),
                            ({"cpus": "some"}, '"cpus" must be a whole number'),
                            ({"cpus": True}, '"cpus" must be a whole number'),
                            ({"meshes_per_job": 0}, '"meshes_per_job" must be'),
                            ({"cpus": 3, "threads": 2}, "must be a multiple of threads"),
                            ({"retry": 7}, '"retry" must be true or false'),
                            ({"time_limit": 600, "job_minutes": 10}, "time_limit")):
            with self.subTest(wrong=wrong), self.assertRaises(WorkflowError) as raised:
                planning.Settings({**right, **wrong})
            self.assertIn(said, str(raised.exception))
            self.assertNotIn("\n", str(raised.exception))


class Pieces(ProgramTest):
    def test_meshes_are_dealt_out_evenly(self):
        meshes = {f"{i:03}.off": (i * 7919) % 1000 for i in range(230)}
        for most, slots, count in ((50, 1, 5), (50, 4, 5), (50, 8, 8), (1, 8, 230), (1000, 0, 1),
                                   (50, 1000, 230)):
            parts = planning.deal(meshes, most, slots)
            self.assertEqual(len(parts), count)
            self.assertEqual(sorted(name for part in parts for name in part), sorted(meshes))
            self.assertLessEqual(max(map(len, parts)) - min(map(len, parts)), 1)
            if count < 10:
                sizes = [sum(meshes[name] for name in part) for part in parts]
                self.assertLess(max(sizes) - min(sizes), 1100)

    def test_a_part_that_slurm_has_in_its_queue_is_not_submitted_twice(self):
        for queued, said in (("", "sbatch --parsable --job-name=morsel-deal-x-0007 --mem=5 script\n"),
                             ("12", "12\n")):
            self.file("squeue",
                      "#!/bin/sh\n[ \"$3\" = --name=morsel-deal-x-0007 ] && "
                      f"printf '{queued}'\n").chmod(0o755)
            self.file("sbatch", "#!/bin/sh\necho sbatch \"$@\"\n").chmod(0o755)
            result = subprocess.run([WORKFLOW / "profiles/slurm/slurm-submit", "work/deal-x/0007", "--mem=5",
                                     "script"],
                                    capture_output=True, text=True, check=True,
                                    env={**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}"})
            self.assertEqual(result.stdout, said)

    def test_the_status_of_a_job_of_slurm(self):
        """With stand-ins for Slurm's programs: a controller that knows the job, does not know it or does not
        answer; a database or none."""
        def status(controller, database="exit 1"):
            for name, script in (("scontrol", controller), ("sacct", database)):
                self.file(name, f"#!/bin/sh\n{script}\n").chmod(0o755)
            result = subprocess.run([WORKFLOW / "profiles/slurm/slurm-status", "7;cluster"],
                                    capture_output=True, text=True, check=False,
                                    env={**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}"})
            self.assertEqual(result.returncode, 0)
            return result.stdout
        forgotten = "echo slurm_load_jobs error: Invalid job id specified >&2; exit 1"
        for state, said in (("COMPLETED", "success"), ("PENDING", "running"), ("RUNNING", "running"),
                            ("COMPLETING", "running"),
                            ("FAILED", "failed"), ("NODE_FAIL", "failed"), ("CANCELLED", "failed"),
                            ("TIMEOUT", "failed"),
                            ("OUT_OF_MEMORY", "failed")):
            self.assertEqual(status(f"[ \"$4\" = 7 ] && echo JobId=7 JobName=x JobState={state} Reason=None"),
                             f"{said}\n")
        self.assertEqual(status("echo slurm_load_jobs error: Unable to contact slurm controller >&2; exit 1"),
                         "running\n")
        self.assertEqual(status(forgotten), "failed\n")
        self.assertEqual(status(forgotten, "echo 'COMPLETED'"), "success\n")
        self.assertEqual(status(forgotten, "echo 'CANCELLED by 1000'"), "failed\n")


if __name__ == "__main__":
    unittest.main()
