"""Runs that meet in one folder, and folders that go away under a run. Each process is stopped where it
matters, so that nothing depends on time."""

import itertools
import shutil
import signal
import subprocess
import unittest

from support import (OCTAHEDRON, PROGRAM, ProgramTest, children_of, made_in, stopped_while_writing, until,
                     writes_into)

ENDLESS = "salient:iterations=1000000"


class Folders(ProgramTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.file("m.off", OCTAHEDRON)

    def start(self, *arguments):
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def caught(self, start, writer, folder):
        """The process that start(method) starts and the number of the one that writes into the folder, which
        writer(process) tells, if any: stopped while it does, with a method that ends."""
        for power in itertools.count(12, 2):
            process = start(f"salient:iterations={1 << power}")
            found = []

            def is_caught(process=process, found=found):
                found[:] = [number for number in writer(process) if stopped_while_writing(number, folder)]
                return found or process.poll() is not None
            until(is_caught)
            if found:
                return process, found[0]
            self.assertEqual(process.returncode, 0)  # too quick: again, with more work
            shutil.rmtree(self.folder / folder.relative_to(self.folder).parts[0])

    def test_a_stopped_run_leaves_the_folder_to_another_that_writes_into_it(self):
        """The one that had made the folder removed it, and the result of the other was lost."""
        folder = self.folder / "x"
        words = ("compare", "m.off", "--field", "height", "--method")
        makers = []

        def start(method):
            for maker in makers:
                maker.kill()
            makers[:] = [self.start(*words, ENDLESS, "-o", "x/b.json")]
            until(lambda: makers[0].poll() is not None or writes_into(makers[0].pid, folder))
            return self.start(*words, method, "-o", "x/a.json")
        run, _ = self.caught(start, lambda process: [process.pid], folder)
        makers[0].send_signal(signal.SIGTERM)
        self.assertEqual(makers[0].wait(60), 143)
        run.send_signal(signal.SIGCONT)
        _, errors = run.communicate(timeout=240)
        self.assertEqual(run.returncode, 0, errors)
        self.assertEqual([path.name for path in folder.iterdir()], ["a.json"])

    def test_an_out_that_is_removed_during_a_batch_is_not_made_again(self):
        """Its processes made OUT again, without a list, and every later run refused it."""
        meshes = self.folder / "meshes"
        meshes.mkdir()
        for name in ("a.off", "b.off"):
            (meshes / name).write_text(OCTAHEDRON)
        out = self.folder / "out"
        words = ("batch", "meshes", "--out", "out", "--jobs", 1, "--field", "height", "--no-thumbnails",
                 "--method")
        run, child = self.caught(lambda method: self.start(*words, method),
                                 lambda process: children_of(process.pid), out / "work")
        out.rename(self.folder / "gone")  # at once, whatever is written there
        shutil.rmtree(self.folder / "gone")
        subprocess.run(["kill", "-CONT", str(child)], check=True)
        _, errors = run.communicate(timeout=240)
        self.assertEqual(run.returncode, 4, errors)
        self.assertRegex(errors, r"\Amorsel: [^\n]*out[^\n]*\n\Z")
        self.assertFalse(out.exists())
        self.morsel(*words, "conventional")
        self.assertIn("summary.csv", [path.name for path in made_in(out)])


if __name__ == "__main__":
    unittest.main()
