"""What the Snakefile does before its jobs: reads the settings and deals the meshes that are to be done out to
parts.

A part is a file with a command, a zero byte after each word, that does up to so many meshes. Parts are kept
until the run ends by itself; those that a killed run left behind are taken up as they are, so that jobs that
a cluster goes on with are not submitted twice.
"""

import fcntl
import hashlib
import json
import math
import os
import pathlib
import shlex
import shutil
import subprocess
import tempfile

import yaml
from snakemake.exceptions import WorkflowError

DEFAULTS = pathlib.Path(__file__).with_name("config.yaml")
NUMBERS = ("meshes_per_job", "cpus", "threads", "memory_limit", "time_limit", "job_minutes")
OWN_MEMORY = 250  # MiB, of what runs the meshes of a job


def lines(data):
    """The lines of bytes in which there are names of files, which may be any bytes themselves."""
    return os.fsdecode(data).split("\n")[:-1]


def words(part):
    """Those of a part's command."""
    return os.fsdecode(part.read_bytes()).split("\0")[:-1]


def planned_name(text):
    """The name that a line of `morsel batch --plan` has: one with control characters is a JSON string."""
    return json.loads(text) if text.startswith('"') else text


class Settings:
    """config.yaml with what the user changed in it, checked."""

    def __init__(self, given):
        values = yaml.safe_load(DEFAULTS.read_text(encoding="utf-8"))
        unknown = sorted(set(given) - set(values))
        if unknown:
            raise WorkflowError(f"there is no setting \"{unknown[0]}\"; there are {', '.join(values)}")
        values.update(given)
        for name in ("collection", "out"):
            if values[name] is None:
                raise WorkflowError(
                    f"the setting \"{name}\" is missing: --config collection=FOLDER out=FOLDER, or a "
                    "--configfile")
        for name in NUMBERS:
            if not isinstance(values[name], int) or isinstance(values[name], bool) or values[name] < 1:
                raise WorkflowError(
                    f"the setting \"{name}\" must be a whole number from 1 on, not {values[name]!r}")
        retry = str(values["retry"]).lower()  # --config knows True and False only
        if retry not in ("true", "false"):
            raise WorkflowError(f"the setting \"retry\" must be true or false, not {values['retry']!r}")
        if values["time_limit"] >= 60 * values["job_minutes"]:
            raise WorkflowError(f"a mesh's time_limit of {values['time_limit']} s must be shorter than a "
                                f"job's job_minutes, {values['job_minutes']} min, or it would never be known "
                                "to have failed")
        if values["cpus"] % values["threads"] != 0:
            raise WorkflowError(
                f"cpus ({values['cpus']}) must be a multiple of threads ({values['threads']})")
        self.program = str(values["morsel"])
        self.collection = str(values["collection"])
        self.out = str(values["out"])
        self.options = self.words(values["options"])
        self.meshes_per_job = values["meshes_per_job"]
        self.cpus = values["cpus"]
        self.threads = values["threads"]
        self.limits = [f"--time-limit={values['time_limit']}", f"--memory-limit={values['memory_limit']}"]
        self.job_memory = self.cpus // self.threads * values["memory_limit"] + OWN_MEMORY
        self.job_minutes = values["job_minutes"]
        self.retry = ["--retry"] if retry == "true" else []

    @staticmethod
    def words(options):
        if isinstance(options, list):
            return [str(word) for word in options]
        try:
            return shlex.split(options or "")
        except (AttributeError, ValueError) as error:
            raise WorkflowError(
                f"the setting \"options\" must be words as they are typed, or a list of them, not "
                f"{options!r}: {error}") from None

    def command(self, *more):
        """The words that run the whole collection in one call, and `more`."""
        return [self.program, "batch", self.collection, f"--out={self.out}", *self.options, *self.limits,
                *more]

    def part(self, names):
        return self.command(f"--threads={self.threads}", f"--jobs={self.cpus // self.threads}",
                            "--no-summary", "--quiet",
                            *self.retry, *(f"--only={name}" for name in names))

    def find_program(self):
        """From here on its whole path; nodes are not asked for it again."""
        found = shutil.which(self.program)
        if found is None:
            raise WorkflowError(
                f"there is no program \"{self.program}\"; name it with its path: --config morsel=PATH/morsel")
        self.program = os.path.abspath(found)

    def open_meshes(self):
        """The names of the meshes that are to be done, with the sizes of their files."""
        told = subprocess.run(self.command("--plan", "--quiet", *self.retry), capture_output=True,
                              check=False)
        if told.returncode != 0:
            raise WorkflowError(os.fsdecode(told.stderr).strip()
                                or f"{self.program} ended with {told.returncode}")
        rows = (line.split("\t", 1) for line in lines(told.stdout))
        return {planned_name(name): int(size) for size, name in rows}


def deal(meshes, most, slots):
    """Names with sizes as lists of names, each of at most `most`, of like number and size; at least `slots`
    if there are as many."""
    count = max(math.ceil(len(meshes) / most), min(slots, len(meshes)))
    names = sorted(meshes, key=lambda name: (-meshes[name], name))
    return [names[i::count] for i in range(count)]


class Plan:
    """The parts of one run, in a folder beside Snakemake's own files: DEAL/parts/NUMBER, of which
    DEAL/done/NUMBER tells that it is done."""

    def __init__(self, settings, slots):
        self.settings = settings
        settings.find_program()
        place = hashlib.sha256(os.fsencode(os.path.abspath(settings.out))).hexdigest()[:12]
        self.work = pathlib.Path(".snakemake", f"morsel-{place}")
        self.work.mkdir(parents=True, exist_ok=True)
        self.lock = self.take_lock()
        self.summary = self.work / "summary"
        self.summary.unlink(missing_ok=True)

        meshes = settings.open_meshes()
        parts = []
        for folder in self.deals():
            kept = [part for part in sorted(folder.glob("parts/*")) if self.is_open(part, meshes)]
            if not kept:
                shutil.rmtree(folder)
            for part in kept:
                for name in self.names(part):
                    meshes.pop(name, None)
            parts += kept
        if meshes:
            parts += self.write(deal(meshes, settings.meshes_per_job, slots))
        self.done = [part.parent.parent / "done" / part.name for part in parts]

    def take_lock(self):
        """Until the process ends, in whatever way."""
        lock = open(self.work / "lock", "w", encoding="utf-8")
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise WorkflowError(f"another run of this workflow is at work on {self.settings.out}") from None
        except OSError:  # a file system without locks
            pass
        return lock

    def deals(self):
        return sorted(path for path in self.work.iterdir() if path.is_dir())

    def names(self, part):
        return [word.removeprefix("--only=") for word in words(part) if word.startswith("--only=")]

    def is_open(self, part, meshes):
        """Whether a killed run left this part to be done, and it is what would be done now."""
        names = self.names(part)
        return (not (part.parent.parent / "done" / part.name).exists()
                and any(name in meshes for name in names)
                and words(part) == self.settings.part(names))

    def write(self, shares):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="deal-", dir=self.work))
        (folder / "parts").mkdir()
        parts = [folder / "parts" / f"{number:04}" for number in range(1, len(shares) + 1)]
        for part, names in zip(parts, shares):
            part.write_bytes(os.fsencode("".join(f"{word}\0" for word in self.settings.part(names))))
        return parts

    def end(self):
        """What is left to do is dealt anew by the next run."""
        for folder in self.deals():
            shutil.rmtree(folder, ignore_errors=True)

    def tell(self):
        """Not all done is a failure of the whole, as it is of `morsel batch`."""
        if lines(self.summary.read_bytes()) != ["0"]:
            raise WorkflowError(
                f"not all meshes are done: {self.settings.out}/summary.csv and index.html tell which and why")
