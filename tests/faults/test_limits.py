"""The program within limits of the system: memory, file size, descriptors, threads, a full disk, closed and
full outputs, signals, what killed runs left."""

import errno
import fcntl
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from scenarios import (METHODS, OCTAHEDRON, Prepared, differences, left_over, library_path, program_path,
                       scenarios)

SCENARIOS = {scenario.name: scenario for scenario in scenarios()}
NOBODY = 65534


class LimitTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def prepared(self, name):
        return Prepared(SCENARIOS[name], program_path(), self.folder / name)

    def run_in(self, folder, arguments, **options):
        return subprocess.run([program_path(), *map(str, arguments)], cwd=folder, capture_output=True,
                              text=True, timeout=120,
                              check=False, **options)

    def check_end(self, ready, folder, result, codes):
        """One sentence for an error, old files or new ones, nothing else; and the next run succeeds."""
        self.assertIn(result.returncode, codes, result.stderr)
        if result.returncode in (3, 4, 5):
            self.assertRegex(result.stderr, r"\A(morsel: warning: .*\n)*morsel: (?!warning).*\n\Z")
        if result.returncode == 0:
            self.assertEqual(differences(ready, folder), [])
        else:
            self.assertEqual(left_over(ready, folder), [])
        again = self.run_in(folder, ready.scenario.arguments)
        self.assertEqual((again.returncode, differences(ready, folder)), (0, []), again.stderr)

    def within(self, name, kind, limits, codes):
        """Runs a scenario under each of the limits; the exit codes that were seen."""
        ready = self.prepared(name)
        seen = set()
        for limit in limits:
            with self.subTest(scenario=name, limit=limit):
                folder = ready.copy(self.folder / "place")
                result = self.run_in(folder, ready.scenario.arguments,
                                     preexec_fn=lambda: resource.setrlimit(kind, (limit, limit)))
                seen.add(result.returncode)
                if result.returncode == 127:  # the system could not load the program
                    self.assertIn("error while loading shared libraries", result.stderr)
                    continue
                self.check_end(ready, folder, result, codes)
        return seen


class Limits(LimitTest):
    def test_memory(self):
        for name in ("report", "compare"):
            seen = self.within(name, resource.RLIMIT_AS, [size << 20
                                                          for size in (60, 120, 150, 180, 200, 230, 260, 300,
                                                                       400, 2000)],
                               (0, 5))
            self.assertIn(5, seen)
            self.assertIn(0, seen)

    def test_file_size(self):
        for name in ("compare", "segment", "cut", "sweep"):
            seen = self.within(name, resource.RLIMIT_FSIZE, (0, 1, 100, 1000, 4000, 1 << 24), (0, 4))
            self.assertEqual(seen, {0, 4})
        self.assertIn(4, self.within("batch", resource.RLIMIT_FSIZE, (0, 100, 2000), (0, 1, 4)))

    def test_descriptors(self):
        for name in ("report", "compare", "batch"):
            seen = self.within(name, resource.RLIMIT_NOFILE, (3, 4, 5, 6, 7, 8, 10, 14, 40), (0, 1, 4, 5))
            self.assertIn(0, seen)

    @staticmethod
    def threads_of_libraries():
        """How many threads libraries make before main(): without these the program cannot begin."""
        with tempfile.TemporaryDirectory() as folder:
            return Prepared(SCENARIOS["version"], program_path(), pathlib.Path(folder) / "version").counts(
                library_path(), pathlib.Path(folder) / "counted", "p")["thread"]

    @unittest.skipIf(os.geteuid() != 0, "only root can become a user whose processes are counted")
    def test_threads_and_processes(self):
        # The limit counts all processes of the user: one of these tests alone.
        user = NOBODY - os.getpid() % 10000
        least = 1 + self.threads_of_libraries()
        self.folder.chmod(0o777)
        program = self.folder / "morsel"
        shutil.copy(program_path(), program)  # that user need not reach where it was built, as in /root
        for name in ("compare", "batch"):
            ready = self.prepared(name)
            for limit in (1, least - 1, least, least + 1, least + 2):
                with self.subTest(scenario=name, limit=limit, least=least):
                    folder = ready.copy(self.folder / "place")
                    for path in (folder, *folder.rglob("*")):
                        os.chown(path, user, user)

                    def confine():
                        resource.setrlimit(resource.RLIMIT_NPROC,
                                           (limit, limit))  # pylint: disable=cell-var-from-loop
                        os.setgroups([])
                        os.setgid(user)
                        os.setuid(user)

                    result = self.run_in(folder, ready.scenario.arguments, preexec_fn=confine,
                                         executable=program)
                    if name == "compare":
                        self.assertEqual(result.returncode, 5 if limit < least else 0, result.stderr)
                    self.check_end(ready, folder, result, (0, 1, 5))

    def test_a_thread_less_is_a_warning(self):
        ready = self.prepared("report")
        folder = ready.copy(self.folder / "place")
        loud = [word for word in ready.scenario.arguments if word != "--quiet"]
        environment = {**os.environ, "LD_PRELOAD": library_path(), "MORSEL_FAULT_KIND": "thread",
                       "MORSEL_FAULT_ALL": "1",
                       "MORSEL_FAULT_AT": str(1 + self.threads_of_libraries()),
                       "MORSEL_FAULT_CODE": str(errno.EAGAIN),
                       "MORSEL_FAULT_SCOPE": "p"}
        result = self.run_in(folder, loud, env=environment)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("morsel: warning: of 2 threads only 1 can be made", result.stderr)

    def test_a_full_disk(self):
        disk = self.folder / "disk"
        disk.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=4m", "tmpfs", disk],
                                 capture_output=True, check=False)
        if mounted.returncode != 0:
            self.skipTest("no file system can be mounted: " + mounted.stderr.decode())
        self.addCleanup(subprocess.run, ["umount", "-l", disk], check=False)
        for name in ("compare", "sweep", "batch"):
            ready = self.prepared(name)
            for free in (0, 8, 40, 160):
                with self.subTest(scenario=name, free=free):
                    for entry in disk.iterdir():
                        shutil.rmtree(entry)
                    folder = ready.copy(disk / "place")
                    filler = disk / "filler"
                    filler.mkdir()
                    room = os.statvfs(disk)
                    (filler / "file").write_bytes(bytes(max(room.f_bavail * room.f_bsize - free * 1024, 0)))
                    result = self.run_in(folder, ready.scenario.arguments)
                    self.assertIn(result.returncode, (0, 1, 4) if name == "batch" else (0, 4), result.stderr)
                    self.assertEqual(left_over(ready, folder), [])


def without_warnings(text):
    return "".join(line for line in text.splitlines(True) if not line.startswith("morsel: warning: "))


class Outputs(LimitTest):
    def test_commands_that_print_fail_if_that_fails(self):
        (self.folder / "mesh.off").write_text(OCTAHEDRON)
        for arguments in (["--help"], ["--version"], ["compare", "--help"], ["info", "mesh.off"],
                          ["info", "mesh.off", "--json"],
                          ["compare", "mesh.off", *METHODS], ["compare", "mesh.off", *METHODS, "-o", "-"],
                          ["hierarchy", "mesh.off", "--field", "height"],
                          ["sweep", "mesh.off", "--vary", "iterations=1,2"]):
            with self.subTest(arguments=arguments):
                command = [program_path(), *arguments]
                with open("/dev/full", "w", encoding="ascii") as full:
                    result = subprocess.run(command, cwd=self.folder, stdout=full, stderr=subprocess.PIPE,
                                            text=True, check=False)
                self.assertEqual(result.returncode, 4)
                self.assertRegex(without_warnings(result.stderr),
                                 r"\Amorsel: cannot write to standard output(: No space left on device)?\n\Z")
                reading, writing = os.pipe()
                os.close(reading)
                result = subprocess.run(command, cwd=self.folder, stdout=writing, stderr=subprocess.PIPE,
                                        text=True, check=False)
                os.close(writing)
                self.assertEqual((result.returncode, without_warnings(result.stderr)), (-signal.SIGPIPE, ""))
                self.assertEqual(os.listdir(self.folder), ["mesh.off"])


class Signals(LimitTest):
    LONG = ("compare", "mesh.off", "--field", "height", "--method", "salient:iterations=1000000",
            *(20 * ("--method", "salient:iterations=1000000")), "-o", "report.json", "--html",
            "page.html")

    def begun(self, **options):
        (self.folder / "mesh.off").write_text(OCTAHEDRON)
        process = subprocess.Popen([program_path(), *self.LONG], cwd=self.folder, stderr=subprocess.PIPE,
                                   text=True, **options)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        end = time.monotonic() + 30
        while not any(name.endswith(" (deleted)") or ".morsel-" in name for name in self.opened(process)):
            self.assertLess(time.monotonic(), end)
            self.assertIsNone(process.poll(), "it has ended")
            time.sleep(0.01)
        time.sleep(0.1)  # its work has begun
        return process

    @staticmethod
    def opened(process):
        folder = f"/proc/{process.pid}/fd"
        try:
            return [os.readlink(os.path.join(folder, file)) for file in os.listdir(folder)]
        except OSError:
            return []

    def test_every_signal_ends_the_run_and_leaves_nothing(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGPIPE, signal.SIGUSR1,
                       signal.SIGUSR2, signal.SIGALRM,
                       signal.SIGXCPU, signal.SIGQUIT, signal.SIGABRT, signal.SIGSEGV, signal.SIGKILL,
                       signal.SIGRTMIN):
            for named in ("0", "1"):
                with self.subTest(signal=number, named=named):
                    environment = {**os.environ, "LD_PRELOAD": library_path(), "MORSEL_FAULT_NAMED": named,
                                   "MORSEL_FAULT_SCOPE": "p"}
                    process = self.begun(env=environment)
                    process.send_signal(number)
                    _, errors = process.communicate(timeout=30)
                    ends = {signal.SIGINT: 130, signal.SIGTERM: 143}
                    self.assertEqual(process.returncode, ends.get(number, -number), errors)
                    left = sorted(os.listdir(self.folder))
                    if named == "1" and number in (signal.SIGKILL, signal.SIGRTMIN):
                        self.assertRegex(" ".join(left), r"\A(\.morsel-\d+-\d+\.tmp ?){2}mesh\.off\Z")
                        subprocess.run([program_path(), "compare", "mesh.off", *METHODS, "-o", "report.json"],
                                       cwd=self.folder,
                                       capture_output=True, check=True)
                        (self.folder / "report.json").unlink()
                        left = os.listdir(self.folder)
                    self.assertEqual(left, ["mesh.off"])

    def test_what_is_ignored_stays_ignored(self):
        process = self.begun(preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        process.send_signal(signal.SIGHUP)
        time.sleep(0.3)
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(30), 143)


class Sweeping(LimitTest):
    def test_only_files_left_over_are_removed(self):
        mesh = self.folder / "mesh.off"
        mesh.write_text(OCTAHEDRON)
        keep = [".morsel-1-x.tmp", ".morsel-1-2.tmp.bak", "morsel-1-2.tmp", ".morsel--2.tmp",
                ".morsel-12.tmp"]
        for name in keep:
            (self.folder / name).write_text("mine")
        (self.folder / ".morsel-5-5.tmp").mkdir()
        (self.folder / ".morsel-6-6.tmp").symlink_to("mesh.off")
        (self.folder / ".morsel-7-7.tmp").write_text("left")
        with open(self.folder / ".morsel-8-8.tmp", "w", encoding="ascii") as used:
            fcntl.flock(used, fcntl.LOCK_EX)
            result = self.run_in(self.folder, ["field", "mesh.off", "--field", "height", "-o", "field.txt"])
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)),
                         sorted([*keep, "mesh.off", "field.txt", ".morsel-5-5.tmp", ".morsel-6-6.tmp",
                                 ".morsel-8-8.tmp"]))
        self.assertEqual(mesh.read_text(), OCTAHEDRON)


if __name__ == "__main__":
    unittest.main()
