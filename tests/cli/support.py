"""Helpers of the command-line tests: running the program and making tiny meshes."""

import csv
import json
import os
import pathlib
import re
import signal
import subprocess
import tempfile
import time
import unittest

PROGRAM = os.environ["MORSEL_PROGRAM"]
SCHEMA = pathlib.Path(os.environ["MORSEL_SCHEMA"])
SAMPLES = pathlib.Path(os.environ["MORSEL_SAMPLES"])

OCTAHEDRON = """OFF
6 8 0
0 0 1
0 0 -1
1 0 0
0 1 0
-1 0 0
0 -1 0
3 0 2 3
3 0 3 4
3 0 4 5
3 0 5 2
3 1 3 2
3 1 4 3
3 1 5 4
3 1 2 5
"""

# Vertex 1 is used by no face, face 2 is degenerate: repair drops both.
DAMAGED = """OFF
5 3 0
0 0 0
9 9 9
1 0 0
1 1 0
0 1 0
3 0 2 3
3 0 3 4
3 0 3 3
"""

# The commands on a mesh that must be whole: words that are quick, {} being the mesh, and each option that
# names a file to write, with the ending of the file.
ON_MESH = {
    "compare": (("compare", "{}", "--method", "conventional"), {"-o": ".json", "--html": ".html"}),
    "field": (("field", "{}", "--points", "2"), {"-o": ".ply", "--json": ".json"}),
    "points": (("points", "{}"), {"-o": ".csv"}),
    "hierarchy": (("hierarchy", "{}", "--levels", "0"), {"-o": ".json"}),
    "segment": (("segment", "{}"), {"-o": ".ply", "--json": ".json"}),
    "cut": (("cut", "{}"), {"-o": ".off", "--json": ".json", "--graph": ".vtp"}),
    "quads": (("quads", "{}", "--field", "height"), {"-o": ".obj", "--json": ".json"}),
    "render": (("render", "{}", "--size", "40x30", "--samples", "1"), {"-o": ".png"}),
    "stability": (("stability", "{}", "--noise", "0.1", "--trials", "1"), {"-o": ".json"}),
    "sweep": (("sweep", "{}", "--vary", "iterations=1..2"), {"-o": ".csv"}),
}


def until(condition, seconds=60):
    """Waits for a condition that other processes cause."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "nothing happened"
        time.sleep(0.005)


def interrupted(folder, arguments, how, code, ready):
    """Runs the program until `ready`, then sends it the signal `how`, of which it must end with `code`. The
    number of entries that journals in the folder have then."""
    with subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=folder, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE) as process:
        until(lambda: process.poll() is not None or ready())
        process.send_signal(how)
        _, errors = process.communicate(timeout=60)
    assert process.returncode == code, (process.returncode, errors)
    return sum(path.read_bytes().count(b"\n") - 1 for path in folder.glob("*.journal"))


def writes_into(process, folder):
    """Whether the process, by its number, has a file in the folder open for writing, be it one without a
    name yet; and is no zombie."""
    files = pathlib.Path(f"/proc/{process}/fd")
    try:
        return any(os.readlink(file).startswith(f"{folder.resolve()}/")
                   and file.lstat().st_mode & 0o200 for file in files.iterdir())
    except OSError:  # of a process or a file that is not there any more
        return False


def stopped_while_writing(process, folder):
    """Stops (SIGSTOP) a process that writes into the folder. False if it does not, any more."""
    if not writes_into(process, folder):
        return False
    os.kill(process, signal.SIGSTOP)

    def state():
        return pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0]
    until(lambda: state() in "TZ")
    if writes_into(process, folder):
        return True
    os.kill(process, signal.SIGCONT)
    return False


def children_of(process):
    """The numbers of its child processes."""
    children = []
    for path in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            if int(path.read_text().rsplit(")", 1)[1].split()[1]) == process:
                children.append(int(path.parent.name))
        except OSError:  # it has ended
            continue
    return children


def made_in(folder):
    """What is in a folder of results, without the list of it."""
    return sorted(path for path in folder.iterdir() if path.name != ".morsel-results")


def without_comments(text):
    """The lines of a text without its comments."""
    return [line for line in text.splitlines() if not line.startswith("#")]


def data_lines(path):
    """The same of a file."""
    return without_comments(path.read_text())


def read_csv(path):
    """The rows of a table, without the comments below them."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


class ProgramTest(unittest.TestCase):
    """A test in a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def morsel(self, *arguments, code=0, cwd=None, **options):
        """Runs the program; its exit code must be `code`, and an error must be one clear line on standard
        error, after warnings."""
        result = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=240,
                                cwd=cwd or self.folder, check=False, **options)
        self.assertEqual(result.returncode, code, f"{arguments}\n{result.stdout}\n{result.stderr}")
        if code in (2, 3, 4, 5):
            self.assertTrue(result.stderr.startswith("morsel: "), result.stderr)
            self.assertRegex(result.stderr, r"\A(morsel: warning: .*\n)*morsel: (?!warning).*\n\Z")
            self.assertEqual(result.stdout, "")
        return result

    def commands(self):
        """The names of all commands, as help lists them."""
        listed = self.morsel().stdout.split("Commands:")[1].split("Examples:")[0]
        return set(re.findall(r"^  (\w+) ", listed, re.MULTILINE)) - {"help"}

    def usage(self, command):
        """The first line of a command's help: what it cannot do without."""
        return self.morsel(command, "--help").stdout.splitlines()[0]

    def report(self, *arguments, name="report.json"):
        self.morsel("compare", *arguments, "-o", name)
        return json.loads((self.folder / name).read_text())
