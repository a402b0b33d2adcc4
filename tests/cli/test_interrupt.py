"""SIGINT at random moments over all commands: exit code 130, soon, and nothing left behind.

In the suite a few moments a command, the same ones each time. Alone, with a number of seconds or of moments,
many more, and the largest latencies: test_interrupt.py --moments 20 [--seed N] [NAME…]. Latencies are in
seconds of a clock and, in brackets, of the processor, which other work on the machine does not lengthen."""

import argparse
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from support import PROGRAM, SAMPLES

# What the suite allows, of the processor and, for machines that are busy with other tests, of a clock. An
# idle one needs less than a second.
MOST_PROCESSOR_SECONDS = 5
MOST_SECONDS = 60
TICKS = os.sysconf("SC_CLK_TCK")

METHODS = {
    "conventional": "conventional",
    "salient": "salient",
    "salient-local": "salient:range=local",
    "salient-connected": "salient:ball=connected",
    "saliency": "saliency",
    "gaussian": "gaussian",
    "laplacian": "laplacian",
    "laplacian-implicit": "laplacian:scheme=implicit",
    "denoise": "denoise",
    "denoise-laplacian": "denoise:kind=laplacian",
    "spectral": "spectral:modes=40",
    "fair": "fair:extrema=20",
    "tps": "tps:threshold=1%",
    "tps-count": "tps:count=100",
}
FIELDS = ("height", "mean-curvature", "gaussian-curvature", "principal-curvature", "curvedness",
          "shape-index", "eigenfunction", "gaussian-curvature:estimator=diffused",
          "heat-kernel-signature:modes=40", "wave-kernel-signature:modes=40",
          "geodesic:source=max-z")


def commands(mesh, small, report, marked):
    """Name → (arguments, what it writes)."""
    result = {
        "compare-all": ("compare", small, "-o", "r.json", "--export", "e", "--figures", "f", "--html",
                        "h.html",
                        "--thumbnails", "t"),
        "compare": ("compare", mesh, "-o", "r.json"),
        "compare-target": ("compare", small, "--target", "50", "--method", "salient", "--method", "gaussian",
                           "-o", "r.json"),
        "html": ("compare", small, "--method", "conventional", "--html", "h.html"),
        "export": ("compare", mesh, "--method", "conventional", "--export", "e"),
        "segment": ("segment", mesh, "-o", "s.ply", "--json", "s.json"),
        "cut": ("cut", mesh, "-o", "c.off", "--json", "c.json", "--graph", "c.vtp"),
        "cut-noisy": ("cut", mesh, "--field", "mean-curvature", "-o", "c.ply"),
        "quads": ("quads", small, "-o", "q.obj", "--json", "q.json", "--field", "eigenfunction:index=12"),
        "hierarchy": ("hierarchy", mesh, "-o", "h.json"),
        "hierarchy-iterations": ("hierarchy", small, "--by", "iteration", "--method", "salient", "-o",
                                 "h.json"),
        "hierarchy-export": ("hierarchy", small, "--export", "e"),
        "molecule": ("molecule", "atoms.pdb", "-o", "m.off", "--resolution", "0.2"),
        "render": ("render", mesh, "-o", "p.png", "--size", "1200x900"),
        "render-arcs": ("render", mesh, "--field", "mean-curvature", "--arcs", "-o", "p.png"),
        "sweep": ("sweep", small, "--vary", "iterations=1..20", "-o", "s.json"),
        "stability": ("stability", small, "--noise", "0.1", "--trials", "5", "-o", "s.json"),
        "stability-decimate": ("stability", small, "--decimate", "0.5", "--trials", "3", "-o", "s.json"),
        "landmarks": ("landmarks", marked, "--method", "conventional", "--method", "salient", "-o", "l.json"),
        "landmarks-salience": ("landmarks", marked, "--rank", "salience", "--figures", "f", "-o", "l.csv"),
        "batch": ("batch", "collection", "--out", "out", "--figures", "--export", "--html"),
        "check": ("check", report),
        "info": ("info", mesh, "--json"),
        "points": ("points", mesh, "-o", "p.csv"),
        "points-salience": ("points", small, "--rank", "salience", "--fill", "mean-curvature", "-o", "p.vtp"),
        "field-write": ("field", mesh, "--field", "height", "-o", "f.vtp"),
    }
    for name, method in METHODS.items():
        result["method-" + name] = ("field", mesh, "--field", "mean-curvature", "--method", method, "-o",
                                    "f.txt")
    for name in FIELDS:
        result["field-" + name] = ("field", mesh, "--field", name, "-o", "f.ply")
    return result


def refined(source, target):
    """Each triangle in four."""
    lines = source.read_text().split("\n")
    vertices, faces = map(int, lines[1].split()[:2])
    rest = [line for line in lines[2:] if line]
    points = [tuple(map(float, line.split()[:3])) for line in rest[:vertices]]
    middle = {}

    def between(a, b):
        key = (a, b) if a < b else (b, a)
        if key not in middle:
            middle[key] = len(points)
            points.append(tuple((x + y) / 2 for x, y in zip(points[a], points[b])))
        return middle[key]

    triangles = []
    for line in rest[vertices:vertices + faces]:
        a, b, c = map(int, line.split()[1:4])
        ab, bc, ca = between(a, b), between(b, c), between(c, a)
        triangles += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    with open(target, "w") as file:
        file.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        file.writelines("%.9g %.9g %.9g\n" % p for p in points)
        file.writelines("3 %d %d %d\n" % t for t in triangles)


def write_atoms(path):
    """A ball of some thousand atoms."""
    draw = random.Random(1)
    with open(path, "w") as file:
        for i in range(3000):
            place = [99.0] * 3
            while sum(x * x for x in place) > 625:
                place = [draw.uniform(-25, 25) for _ in range(3)]
            file.write("ATOM  %5d  CA  ALA A%4d    %8.3f%8.3f%8.3f  1.00  0.00           C\n"
                       % (i + 1, i + 1, *place))
        file.write("END\n")


# Where the tests run in the background it may be ignored, and what is ignored stays so in the program.
signal.signal(signal.SIGINT, signal.default_int_handler)


def processor_seconds(pid):
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / TICKS


class Setting:
    """The files that the commands take."""

    def __init__(self, folder):
        self.folder = folder
        self.small = SAMPLES / "bunny00.off"
        self.mesh = folder / "refined.off"
        refined(self.small, self.mesh)
        write_atoms(folder / "atoms.pdb")
        self.marked = folder / "marked.txt"
        self.marked.write_text(f"\"{self.small}\" \"{folder / 'marks.txt'}\"\n\"{self.mesh}\" marks.txt\n")
        (folder / "marks.txt").write_text("0 1000 2000 3000 4000 5000")
        self.report = folder / "report.json"
        subprocess.run([PROGRAM, "compare", self.small, "--quiet", "-o", self.report], check=True,
                       stdout=subprocess.DEVNULL)

    def commands(self):
        return commands(self.mesh, self.small, self.report, self.marked)

    def moment(self, arguments, wait):
        """Runs the command in a folder of its own and interrupts it. Exit code, latency in seconds, of the
        processor, and the time that it ran."""
        with tempfile.TemporaryDirectory(dir=self.folder) as name:
            work = pathlib.Path(name)
            (work / "atoms.pdb").symlink_to(self.folder / "atoms.pdb")
            (work / "collection").mkdir()
            for i in range(3):
                (work / "collection" / f"{i}.off").symlink_to(self.small)
            before = {path.relative_to(work) for path in work.rglob("*")}
            start = time.monotonic()
            # pylint: disable=consider-using-with
            process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=work, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.PIPE, text=True)
            try:
                _, errors = process.communicate(timeout=wait)
                sent = time.monotonic()
                latency = busy = used = 0
            except subprocess.TimeoutExpired:
                sent = time.monotonic()
                used = processor_seconds(process.pid)
                process.send_signal(signal.SIGINT)
                with process.stderr:
                    errors = process.stderr.read()
                _, status, usage = os.wait4(process.pid, 0)
                process.returncode = os.waitstatus_to_exitcode(status)
                latency = time.monotonic() - sent
                busy = max(0, usage.ru_utime + usage.ru_stime - used)
            left = {path.relative_to(work) for path in work.rglob("*")} - before
            if process.returncode == -signal.SIGINT and used < 0.1 and not left:
                process.returncode = 0  # main() had not begun
            problem = self.problem(arguments, process.returncode, errors, left)
            return process.returncode, latency, busy, sent - start, problem

    @staticmethod
    def problem(arguments, code, errors, left):
        """What is wrong after an interruption; '' if nothing is."""
        if code == 0:
            return ""
        if code != 130:
            return f"exit code {code}: {errors}"
        if not errors.endswith("morsel: interrupted\n"):
            return f"said {errors!r}"
        several = {"--export", "--figures", "--thumbnails", "--html", "--json", "--graph"}
        if arguments[0] in ("batch", "sweep", "stability", "landmarks") or several & set(arguments):
            left = {path for path in left if ".tmp" in path.name}  # what was finished before may stay
        return f"left {sorted(map(str, left))}" if left else ""


class Interrupt(unittest.TestCase):
    def test_commands_end_soon_and_leave_nothing(self):
        draw = random.Random(15)
        with tempfile.TemporaryDirectory() as name:
            setting = Setting(pathlib.Path(name))
            latencies = []
            for command, arguments in setting.commands().items():
                with self.subTest(command):
                    code, latency, busy, _, problem = setting.moment(arguments, draw.uniform(0.05, 1.5))
                    self.assertEqual(problem, "")
                    self.assertLess(busy, MOST_PROCESSOR_SECONDS)
                    self.assertLess(latency, MOST_SECONDS)
                    if code == 130:
                        latencies.append((latency, busy, command))
            latencies.sort(reverse=True)
            self.assertGreater(len(latencies), 20)
            median = latencies[len(latencies) // 2][0]
            print(f"{len(latencies)} interruptions, median {median:.2f} s, the longest:",
                  ", ".join(f"{name} {latency:.2f} s ({busy:.2f})" for latency, busy, name in latencies[:5]))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--moments", type=int, required=True, help="a command")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--longest", type=float, default=20,
                        help="seconds after which a command is interrupted at the latest")
    parser.add_argument("--above", type=float, default=1,
                        help="processor seconds from which on a moment is reported")
    parser.add_argument("names", nargs="*")
    given = parser.parse_args()
    draw = random.Random(given.seed)
    problems = 0
    with tempfile.TemporaryDirectory() as name:
        setting = Setting(pathlib.Path(name))
        for command, arguments in setting.commands().items():
            if given.names and command not in given.names:
                continue
            longest = given.longest
            seen = []
            for _ in range(given.moments):
                wait = draw.uniform(0.02, longest)
                code, latency, busy, ran, problem = setting.moment(arguments, wait)
                if code == 0:
                    longest = min(longest, ran)
                if problem:
                    problems += 1
                    print(f"  {command} after {ran:.2f} s: {problem}")
                if code == 130:
                    seen.append((latency, busy, ran))
                    if busy > given.above:
                        print(f"  {command} after {ran:.2f} s: {latency:.2f} s ({busy:.2f})")
            seen.sort(reverse=True)
            told = ", ".join(f"{latency:.2f} ({busy:.2f}) at {ran:.1f}" for latency, busy, ran in seen[:3])
            print(f"{command}: {len(seen)} of {given.moments} interrupted; {told}", flush=True)
    return 1 if problems else 0


if __name__ == "__main__":
    if "--moments" in sys.argv:
        sys.exit(main())
    unittest.main()
