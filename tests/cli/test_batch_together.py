"""morsel batch: several runs in one folder, and interrupted ones."""

import fcntl
import json
import resource
import shutil
import signal
import subprocess
import unittest

from support import PROGRAM, until
from test_batch import AtWork, contents

LONG_ENOUGH = ("--method", "conventional", "--method", "salient:iterations=400")


class Together(AtWork):
    def start(self, *arguments, **options):
        process = subprocess.Popen([PROGRAM, "batch", "meshes", "--out", "out", *arguments], cwd=self.folder,
                                   text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def in_work(self, count):
        """Until so many meshes are in work."""
        until(lambda: len(self.children()) == count)

    def ends(self, process, code=0):
        out, errors = process.communicate(timeout=240)
        self.assertEqual(process.returncode, code, errors)
        return out

    def check_whole(self):
        """All files are of one request."""
        for state in (self.out / "state").rglob("*.json"):
            name = str(state.relative_to(self.out / "state"))
            state = json.loads(state.read_text())
            self.assertEqual(state["status"], "done")
            report = json.loads((self.out / "reports" / name).read_text())
            self.assertEqual(report["timings"], state["timings"], name)
            self.assertEqual(report["request"].get("snap", False), state["key"]["request"]["snap"], name)
            page = (self.out / "pages" / f"{name[:-5]}.html").read_text()
            self.assertEqual("--snap" in page, state["key"]["request"]["snap"], name)
        self.assertEqual([path for path in self.out.rglob("*") if path.suffix in (".part", ".tmp")
                          or path.name == "work"], [])

    def test_two_runs_on_one_mesh_are_independent(self):
        """The second one once emptied the folder that the first one worked in."""
        arguments = ("--only", "sphere.off", "--no-summary", "--html", *LONG_ENOUGH)
        one = self.start(*arguments)
        self.in_work(1)
        other = self.start(*arguments)
        self.assertIn("1 done", self.ends(one))
        self.assertIn("1 done", self.ends(other))
        self.check_whole()

    def test_runs_with_other_options_are_not_mixed(self):
        many = ("--html", "--figures", "--size", "120x90", "--export", "--method", "conventional")
        for _ in range(3):
            processes = [self.start(*many, *more) for more in ((), ("--snap",), ("--snap", "--jobs", "3"))]
            for process in processes:
                self.ends(process)
            self.check_whole()

    def test_a_killed_run_s_work_is_removed_and_a_live_one_s_is_not(self):
        killed = self.start("--only", "sphere.off", "--no-summary", *LONG_ENOUGH)
        self.in_work(1)
        killed.kill()
        self.ends(killed, -signal.SIGKILL)
        until(lambda: not self.children())
        left, = (self.out / "work").iterdir()
        live = self.start("--only", "sphere.off", "--no-summary", *LONG_ENOUGH)
        self.in_work(1)
        self.assertFalse(left.exists())
        kept, = (self.out / "work").iterdir()
        self.batch("--only", "octahedron.off", "--no-summary")
        self.assertTrue(kept.exists())
        self.ends(live)
        self.assertFalse((self.out / "work").exists())

    def test_a_work_folder_that_is_not_listed_stays(self):
        self.batch("--only", "octahedron.off")
        foreign = self.out / "work/abcdef/0"
        foreign.mkdir(parents=True)
        self.batch()
        self.assertEqual(list((self.out / "work").rglob("*")), [foreign.parent, foreign])

    def test_a_run_waits_while_another_puts_its_results_in_place(self):
        self.batch("--only", "octahedron.off", "--no-summary")
        with open(self.out / ".morsel-results", "r+", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            process = self.start("--only", "sphere.off", "--no-summary", "--method", "conventional")
            with self.assertRaises(subprocess.TimeoutExpired):
                process.wait(2)
            self.assertFalse((self.out / "reports/sphere.off.json").exists())
        self.ends(process)

    def test_a_killed_child_is_a_failure_that_passes(self):
        process = self.start("--only", "sphere.off", *LONG_ENOUGH)
        self.in_work(1)
        subprocess.run(["kill", "-9", *self.children()], check=True)
        self.assertIn("1 failed", self.ends(process, 1))
        error = next(mesh for mesh in self.summary()["meshes"] if mesh["name"] == "sphere.off")["error"]
        self.assertEqual((error["kind"], error["signal"]), ("signal", 9))
        self.assertIn("1 done", self.morsel("batch", "meshes", "--out", "out", "--only", "sphere.off",
                                            "--method",
                                            "conventional", "--method", "salient:iterations=400").stdout)

    def test_a_full_disk_leaves_nothing_half_done(self):
        def no_large_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))

        process = self.start("--method", "conventional", "--no-summary", preexec_fn=no_large_files)
        self.assertIn("1 done, 2 failed", self.ends(process, 1))
        state = json.loads((self.out / "state/sphere.off.json").read_text())
        self.assertEqual((state["error"]["kind"], state["error"]["exit_code"]), ("exit-code", 4))
        self.assertFalse((self.out / "reports/sphere.off.json").exists())
        self.assertIn("3 done, 0 failed (1 by earlier runs)",
                      self.morsel("batch", "meshes", "--out", "out", "--method", "conventional").stdout)
        shutil.rmtree(self.out / "plots")
        self.morsel("batch", "meshes", "--out", "whole", "--method", "conventional")
        shutil.rmtree(self.folder / "whole/plots")
        for kind in ("reports", "state", "thumbnails"):
            self.assertEqual(contents(self.out / kind), contents(self.folder / "whole" / kind))


if __name__ == "__main__":
    unittest.main()
