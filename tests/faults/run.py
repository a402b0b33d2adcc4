#!/usr/bin/env python3
"""Runs commands while the system fails at a chosen call, and checks what is promised of every end of the
program.

    run.py [RUNS] [--seed S] [--seconds T]     RUNS faults drawn at random (default 300), at most T seconds
    run.py --one SCENARIO SCOPE KIND AT ALL CODE NAMED    one of them, as a violation names it, and its
    outcome

The environment names the program (MORSEL_PROGRAM) and the library that makes calls fail (MORSEL_FAULTS,
inject.c). Promised are, whatever fails: a documented exit code, that of what failed; one sentence on standard
error; existing files are unchanged or complete new ones; nothing else is left; and the next run
succeeds with equal results. Ends with 1 if there was a violation.
"""

import argparse
import concurrent.futures
import dataclasses
import errno
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

from scenarios import Prepared, differences, left_over, library_path, program_path, scenarios

# Kinds of calls (inject.c): how often they are drawn, the errors that they fail with, the exit codes that may
# come of it.
KINDS = {
    "memory": (8, (errno.ENOMEM,), (5,)),
    "map": (2, (errno.ENOMEM,), (5,)),
    "open": (3, (errno.EMFILE, errno.ENFILE, errno.EIO), (3, 4, 5)),
    "read": (1, (errno.EIO,), (3, 4)),
    "write": (3, (errno.ENOSPC, errno.EIO, errno.EDQUOT), (4,)),
    "sync": (1, (errno.EIO, errno.ENOSPC), (4,)),
    "name": (2, (errno.EIO, errno.ENOSPC, errno.EACCES), (4,)),
    "remove": (1, (errno.EACCES, errno.EIO), (4,)),
    "folder": (1, (errno.ENOSPC, errno.EACCES), (4,)),
    "status": (1, (errno.ENOMEM, errno.EIO), (3, 4, 5)),
    "thread": (2, (errno.EAGAIN,), (5,)),
    "process": (1, (errno.EAGAIN, errno.EMFILE, errno.ENOMEM), (5,)),
    "signal": (6, (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGPIPE, signal.SIGUSR1,
                   signal.SIGXCPU, signal.SIGKILL, signal.SIGXFSZ), ()),
}
WITH_CODES = (signal.SIGINT, signal.SIGTERM)  # once main() has begun; others end the process as signals
TIME_LIMIT = 60


@dataclasses.dataclass(frozen=True)
class Fault:
    scenario: str
    scope: str  # p: the program itself, c: the processes that it starts
    kind: str
    at: int
    all: int
    code: int
    named: int

    def environment(self):
        return {f"MORSEL_FAULT_{field.name.upper()}": str(getattr(self, field.name))
                for field in dataclasses.fields(self) if field.name != "scenario"}

    def __str__(self):
        return " ".join(repr(v) if " " in str(v) else str(v) for v in dataclasses.astuple(self))


def draw(random_numbers, prepared, counts):
    while True:
        name = random_numbers.choice(sorted(prepared))
        scope = random_numbers.choice("pc") if name.startswith("batch") else "p"
        kind = random_numbers.choices(list(KINDS), [weight for weight, _, _ in KINDS.values()])[0]
        number = counts[name, scope][kind]
        if number > 0:
            break
    # Beginnings and ends are where the rare calls are.
    at = random_numbers.choice((random_numbers.randint(1, number), random_numbers.randint(1, min(number, 40)),
                                random_numbers.randint(max(1, number - 40), number)))
    once = kind == "signal" or random_numbers.random() < 0.6
    return Fault(name, scope, kind, at, 0 if once else 1, int(random_numbers.choice(KINDS[kind][1])),
                 int(random_numbers.random() < 0.25))


def allowed_codes(fault):
    """Of the program; 0 if what failed was not needed."""
    if fault.kind != "signal":
        codes = KINDS[fault.kind][2] if fault.scope == "p" else ()
    elif fault.code == signal.SIGXFSZ:  # ignored from the beginning of main() on
        codes = (-fault.code,)
    else:
        ends = (-fault.code, *((128 + fault.code,) if fault.code in WITH_CODES else ()))
        codes = ends if fault.scope == "p" else ()
    return (0, *codes, *((1,) if fault.scenario.startswith("batch") else ()))


def wrong_words(fault, code, errors):
    """What is wrong with standard error."""
    lines = errors.splitlines()
    sentences = [line for line in lines if line.startswith("morsel: ")
                 and not line.startswith("morsel: warning: ")]
    others = [line for line in lines if not line.startswith("morsel: ")]
    if code in (2, 3, 4, 5):
        expected = (1,)
    else:
        expected = (0, 1) if code in (130, 143) or code < 0 else (0,)  # 0: of signals before main()
    wrong = []
    if len(sentences) not in expected:
        wrong.append(f"{len(sentences)} sentences")
    if others:
        wrong.append("other words on standard error")
    if any("defect" in line for line in sentences):
        wrong.append("a fault is taken for a defect")
    return wrong


def wrong_children(fault, folder):
    """What is wrong with how a batch's children ended."""
    wrong = []
    for path in (folder / "out" / "state").glob("**/*.json"):
        error = json.loads(path.read_text()).get("error")
        if error is None:
            continue
        child = Fault(fault.scenario, "p", *dataclasses.astuple(fault)[2:])
        end = -error["signal"] if error["kind"] == "signal" else error["exit_code"]
        if fault.kind == "read" and end == -signal.SIGKILL:
            continue  # by a batch that could not read what it says
        if fault.scope == "p" or end not in allowed_codes(child):
            wrong.append(f"a child ended with {end}: {error['message']}")
        elif "defect" in error["message"]:
            wrong.append(f"a child's fault is taken for a defect: {error['message']}")
    return wrong


def run(fault, prepared, folder, tell=None):
    """Whether the fault occurred, and what was wrong then."""
    ready = prepared[fault.scenario]
    place = ready.copy(folder / "place")
    mark = folder / "mark"
    mark.unlink(missing_ok=True)
    environment = {**os.environ, **fault.environment(), "LD_PRELOAD": library_path(),
                   "MORSEL_FAULT_MARK": str(mark)}
    try:
        result = subprocess.run(ready.scenario.command(ready.program), cwd=place, env=environment,
                                capture_output=True,
                                timeout=TIME_LIMIT, check=False)
    except subprocess.TimeoutExpired:
        return True, [f"no end in {TIME_LIMIT} s"]
    errors = result.stderr.decode(errors="replace")
    if tell:
        tell(f"exit code {result.returncode}\n{errors}")
    came = mark.exists()
    wrong = []
    if result.returncode == 127 and "error while loading shared libraries" in errors:
        return came, []  # the system could not start the program
    if result.returncode not in allowed_codes(fault):
        wrong.append(f"exit code {result.returncode}")
    wrong += wrong_words(fault, result.returncode, errors)
    if fault.scenario.startswith("batch"):
        wrong += wrong_children(fault, place)
    # Files left over are removed by the next run.
    swept = (r"\.morsel-[0-9]+-[0-9]+\.tmp$",
             ) if fault.kind == "remove" or fault.code == signal.SIGKILL else ()
    if result.returncode == 0 and fault.kind != "remove":
        wrong += differences(ready, place)
    else:
        wrong += left_over(ready, place, swept)
    again = subprocess.run(ready.scenario.command(ready.program), cwd=place, capture_output=True,
                           timeout=TIME_LIMIT, check=False)
    if again.returncode != 0:
        wrong.append(f"the next run ends with {again.returncode}: {again.stderr.decode(errors='replace')}")
    wrong += [f"after the next run {what}" for what in differences(ready, place)]
    if wrong:
        wrong.append(f"exit code {result.returncode}, standard error: {errors.strip()!r}")
    return came, wrong


def prepare(folder):
    prepared, counts = {}, {}
    for i, scenario in enumerate(scenarios()):
        ready = prepared[scenario.name] = Prepared(scenario, program_path(), folder / f"scenario{i}")
        for scope in "pc" if scenario.name.startswith("batch") else "p":
            counts[scenario.name, scope] = ready.counts(library_path(), folder / f"scenario{i}" / "counted",
                                                        scope)
    return prepared, counts


def run_many(options, folder):
    prepared, counts = prepare(folder)
    random_numbers = random.Random(options.seed)
    end = time.monotonic() + options.seconds
    faults = [draw(random_numbers, prepared, counts) for _ in range(options.runs)]
    local = threading.local()
    numbers = iter(range(1_000_000))

    def work(fault):
        if time.monotonic() > end:
            return None
        if not hasattr(local, "folder"):
            local.folder = folder / f"worker{next(numbers)}"
            local.folder.mkdir()
        return fault, *run(fault, prepared, local.folder)

    runs = came_about = violations = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for result in pool.map(work, faults):
            if result is None:
                continue
            fault, came, wrong = result
            runs += 1
            came_about += came
            if wrong:
                violations += 1
                print(f"{fault}: " + "; ".join(wrong), flush=True)
    print(f"runs {runs}, faults {came_about}, violations {violations}", flush=True)
    return 1 if violations or not came_about else 0


def main():
    parser = argparse.ArgumentParser(description="Runs morsel while the system fails.")
    parser.add_argument("runs", type=int, nargs="?", default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=1e9)
    parser.add_argument("--one", nargs=7, metavar=("SCENARIO", "SCOPE", "KIND", "AT", "ALL", "CODE", "NAMED"))
    options = parser.parse_args()
    memory = pathlib.Path("/dev/shm")  # where syncing costs nothing
    base = memory if os.access(memory, os.W_OK) and shutil.disk_usage(memory).free > 1 << 28 else None
    with tempfile.TemporaryDirectory(dir=base) as name:
        folder = pathlib.Path(name)
        if not options.one:
            return run_many(options, folder)
        scenario, scope, kind, *numbers = options.one
        fault = Fault(scenario, scope, kind, *map(int, numbers))
        prepared, _ = prepare(folder)
        _, wrong = run(fault, prepared, folder, tell=print)
        print("\n".join(wrong))
        return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
