"""What is run under faults: commands with all their outputs on tiny meshes, and how results are compared."""

import csv
import json
import os
import pathlib
import re
import shutil
import subprocess

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

LIST = ".morsel-results"  # of the files that were made in a folder

METHODS = ("--field", "height", "--method", "conventional", "--method", "salient:iterations=1")


class Scenario:
    """A command, its input files, and the files that it may make."""

    def __init__(self, name, arguments, meshes=("mesh.off",), before=(), working=()):
        self.name = name
        self.arguments = arguments
        self.meshes = meshes
        self.before = before  # the command that makes what is there already, with other contents
        self.working = working  # patterns of what a broken-off run may leave for the next one

    def command(self, program, before=False):
        return [program, *(self.before if before else self.arguments)]

    def make_inputs(self, folder):
        for mesh in self.meshes:
            path = folder / mesh
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(OCTAHEDRON)


def scenarios():
    compare = ("compare", "mesh.off", *METHODS, "--quiet", "--threads", "2", "-o", "report.json")
    everything = ("--html", "page.html", "--figures", "figures", "--export", "files", "--thumbnails", "small",
                  "--size", "32x32",
                  "--view", "0/0")
    sweep = ("sweep", "mesh.off", "--vary", "iterations=1,2", "--method", "salient", "--quiet", "--threads",
             "2", "--field")
    batch = ("batch", "meshes", "--out", "out", *METHODS, "--quiet")
    segment = ("segment", "mesh.off", "--quiet", "--threads", "2", "--field")
    cut = ("cut", "mesh.off", "--quiet", "--threads", "2", "--field")
    axis = ("--field", "height:axis=x")
    both = ("meshes/a.off", "meshes/b.off")
    work = (r"out/work(/.*)?", r"out/state", r"out/\.[^/]*")
    return [
        Scenario("report", (*compare,), before=("compare", "mesh.off", *axis, "--quiet", "-o",
                                                "report.json")),
        Scenario("compare", (*compare, *everything),
                 before=("compare", "mesh.off", *axis, *METHODS[2:], "--quiet", *everything, "-o",
                         "report.json")),
        Scenario("sweep", (*sweep, "height", "-o", "sweep.csv", "--figures", "plots"),
                 before=(*sweep, "height:axis=x", "-o", "sweep.csv"),
                 working=(r"sweep\.csv\.journal",)),
        Scenario("segment", (*segment, "height", "-o", "segments.ply", "--json", "segments.json"),
                 before=(*segment, "height:axis=x", "-o", "segments.ply", "--json", "segments.json")),
        Scenario("cut", (*cut, "height", "-o", "cut.off", "--json", "cut.json", "--graph", "cut.vtp"),
                 before=(*cut, "height:axis=x", "-o", "cut.off", "--json", "cut.json", "--graph", "cut.vtp")),
        Scenario("batch", (*batch, "--jobs", "1", "--no-thumbnails"), meshes=both, working=work),
        Scenario("batch all", (*batch, "--jobs", "2", "--export", "--html"), meshes=both, working=work),
        Scenario("help", ("compare", "--help")),
        Scenario("version", ("--version",)),
        Scenario("table", ("compare", "mesh.off", *METHODS, "--quiet")),
        Scenario("info", ("info", "mesh.off", "--json")),
    ]


def listed(data):
    """What a folder's list says was made in it."""
    entries = set()
    for line in filter(None, data.decode().split("\n")[1:-1]):  # a truncated last line is ignored
        (entries.add if line[0] == "+" else entries.discard)(line[1:].split(" ")[0])
    return entries


def plain(path):
    """The contents of a file without what differs from run to run: times."""
    data = path.read_bytes()
    if path.name == LIST:
        return json.dumps(sorted(listed(data)))
    if path.suffix == ".json":
        try:
            return json.dumps(without_times(json.loads(data)))
        except ValueError:
            return data
    if path.suffix == ".csv":
        with open(path, newline="", encoding="utf-8") as table:
            return json.dumps([without_times(row) for row in csv.DictReader(table)])
    if path.suffix == ".html":
        text = re.sub(r'"[A-Za-z0-9+/=]{40,}"', '"data"', data.decode())  # packed reports hold times
        return re.sub(r"[0-9]+(\.[0-9]+)?(e-?[0-9]+)?", "#", text)
    return data


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(item) for key, item in value.items() if key not in ("timings", "seconds")}
    if isinstance(value, list):
        return [without_times(item) for item in value]
    return value


def tree(folder):
    """Every entry of a folder: of files their contents, of folders None. Not the lists of folders of results,
    which name files before they appear, in the order of the run."""
    return {str(path.relative_to(folder)): plain(path) if path.is_file() else None
            for path in folder.rglob("*")
            if path.name != ".morsel-results"}


class Prepared:
    """A scenario with the folder that runs begin with, and what an undisturbed run makes of it."""

    def __init__(self, scenario, program, folder):
        self.scenario = scenario
        self.program = program
        self.start = folder / "start"
        self.start.mkdir(parents=True)
        scenario.make_inputs(self.start)
        if scenario.before:
            subprocess.run(scenario.command(program, before=True), cwd=self.start, check=True,
                           capture_output=True)
        self.old = tree(self.start)
        done = self.copy(folder / "done")
        subprocess.run(scenario.command(program), cwd=done, check=True, capture_output=True)
        self.new = tree(done)

    def copy(self, folder):
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self.start, folder)
        return folder

    def counts(self, library, folder, scope):
        """How many calls of each kind the undisturbed run makes."""
        self.copy(folder)
        counts = folder.parent / "counts"
        environment = {"LD_PRELOAD": library, "MORSEL_FAULT_COUNTS": str(counts), "MORSEL_FAULT_SCOPE": scope}
        subprocess.run(self.scenario.command(self.program), cwd=folder, check=True, capture_output=True,
                       env={**os.environ, **environment})
        return {kind: int(number) for kind, number in map(str.split, counts.read_text().splitlines())}


def is_working(scenario, name):
    return pathlib.Path(name).name == LIST or any(re.fullmatch(pattern, name) for pattern in scenario.working)


def left_over(prepared, folder, ignored=()):
    """What is wrong with a folder after a failed run, as sentences."""
    wrong = []
    now = tree(folder)
    for name, contents in now.items():
        if is_working(prepared.scenario, name) or any(re.search(pattern, name) for pattern in ignored):
            continue
        if name not in prepared.old and name not in prepared.new:
            wrong.append(f"{name} is left")
        elif contents not in (prepared.old.get(name, contents), prepared.new.get(name, contents)):
            wrong.append(f"{name} is neither the old file nor the new one")
        elif name not in prepared.new and contents != prepared.old[name]:
            wrong.append(f"{name} has changed")
    wrong += [f"{name} is gone" for name in prepared.old if name not in now
              and not is_working(prepared.scenario, name)]
    return wrong


def differences(prepared, folder):
    """What is wrong with a folder after a run that succeeded."""
    now = tree(folder)
    return ([f"{name} is left" for name in now if name not in prepared.new] +
            [f"{name} is missing" for name in prepared.new if name not in now] +
            [f"{name} differs" for name in now if name in prepared.new and now[name] != prepared.new[name]])


def program_path():
    return os.environ["MORSEL_PROGRAM"]


def library_path():
    return str(pathlib.Path(os.environ["MORSEL_FAULTS"]))
