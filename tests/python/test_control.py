"""Progress, cancellation, Ctrl-C, the interpreter lock, threads, exceptions."""

import os
import pathlib
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest
from conftest import sample

import morsel as ms


@pytest.fixture(scope="module")
def long_field():
    """On which salient smoothing takes long: the lion subdivided to 300,000 vertices."""
    mesh = ms.read(sample("lion-head.off")).subdivided(6)
    return ms.field(mesh, np.sin(np.arange(mesh.vertex_count) % 1000))


def long_work(f, **options):
    """Minutes of work."""
    return ms.salient(f, iterations=100000, sigma="20eps", **options)


def test_progress(curvature):
    seen = []
    ms.salient(curvature, iterations=20, progress=lambda step, fraction: seen.append((step, fraction)))
    assert seen and all(isinstance(step, str) and 0 <= fraction <= 1 for step, fraction in seen)


def test_progress_is_told_on_the_thread_that_asked(long_field):
    told = set()

    def report(step, fraction):
        told.add(threading.current_thread())
        return len(told) < 1

    with pytest.raises(ms.Cancelled):
        long_work(long_field, progress=report)
    assert told == {threading.current_thread()}


def test_a_bar(curvature, capfd):
    ms.salient(curvature, iterations=200, progress=True)
    shown = capfd.readouterr()
    assert shown.out == "" and "%" in shown.err and "\r" in shown.err
    ms.salient(curvature, iterations=2)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("progress", [3, "yes", object()])
def test_what_is_no_progress(curvature, progress):
    with pytest.raises(TypeError):
        ms.salient(curvature, progress=progress)


def test_cancelling(long_field):
    start = time.monotonic()
    with pytest.raises(ms.Cancelled) as caught:
        long_work(long_field, progress=lambda step, fraction: False)
    assert time.monotonic() - start < 20 and isinstance(caught.value, ms.Error)


@pytest.mark.parametrize("no", [False, np.False_], ids=["Python's", "numpy's"])
def test_false_ends_the_work(curvature, long_field, no):
    g = ms.salient(curvature, iterations=5, on_iteration=lambda number, f: no if number == 3 else None)
    assert g.steps[0].end == (3, "caller")
    with pytest.raises(ms.Cancelled):
        long_work(long_field, progress=lambda step, fraction: no)


@pytest.mark.parametrize("yes", [None, True, np.True_], ids=["None", "True", "numpy's"])
def test_anything_else_does_not(curvature, yes):
    g = ms.salient(curvature, iterations=3, progress=lambda step, fraction: yes,
                   on_iteration=lambda number, f: yes)
    assert g.steps[0].end == (3, "iterations")


def test_exceptions_of_the_progress_function(long_field):
    class Mine(Exception):
        """Of the test."""

    error = Mine("what the function says")

    def report(step, fraction):
        raise error

    with pytest.raises(Mine) as caught:
        long_work(long_field, progress=report)
    assert caught.value is error and any(entry.name == "report" for entry in caught.traceback)


def test_exceptions_of_the_iteration_function(curvature):
    def each(number, f):
        if number == 2:
            raise KeyError("two")

    with pytest.raises(KeyError, match="two"):
        ms.salient(curvature, iterations=5, on_iteration=each)


def test_python_goes_on_meanwhile(long_field):
    count, ticks = [0], []

    def tick():
        while not ticks:
            count[0] += 1
            time.sleep(0.005)

    other = threading.Thread(target=tick, daemon=True)
    other.start()
    seen = [0]

    def report(step, fraction):
        seen[0] += 1
        return seen[0] < 10

    with pytest.raises(ms.Cancelled):
        ms.salient(long_field, iterations=100000, sigma="2eps", progress=report)  # short iterations
    ticks.append(True)
    other.join()
    assert count[0] > 10


def test_from_several_threads(small):
    f = ms.mean_curvature(small)
    expected = ms.salient(f, iterations=3).values
    results = [None] * 6

    def work(i):
        results[i] = ms.salient(f, iterations=3, progress=lambda step, fraction: None).values

    threads = [threading.Thread(target=work, args=(i,)) for i in range(len(results))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(result, expected) for result in results)


SCRIPT = """
    import sys, time
    import numpy as np
    import morsel as ms
    mesh = ms.read({mesh!r}).subdivided({pieces})
    f = ms.field(mesh, np.sin(np.arange(mesh.vertex_count) % 1000))
    {define}
    print("ready", flush=True)
    try:
        {work}
    except KeyboardInterrupt:
        print("interrupted", flush=True)
"""

# A method that is as quick as its parameter, or never ends, and says on which thread it is.
SLOW = """
    import threading
    ends = [True]

    @ms.method("slow")
    def slow(f):
        assert threading.current_thread() is threading.main_thread()
        while not ends[0]:
            time.sleep(0.001)
        return f.values
"""

WORK = {
    "a method": (6, "", "ms.salient(f, iterations=100000, sigma='20eps')"),
    "a comparison": (6, "", "ms.compare(f, methods=['salient:iterations=100000,sigma=20eps'])"),
    "a study": (6, "",
                "ms.stability(mesh, fields=['height'], methods=['salient:iterations=1000'], trials=1000)"),
    "eigenfunctions": (6, "", "ms.eigenfunction(mesh, index=300)"),
    "python in a method": (1, SLOW + """
    ends[0] = False
    """, "ms.compare(f, methods=['slow'])"),
    "python in a check": (1, SLOW + """
    ms.compare(ms.read({mesh!r}), methods=["slow"]).save("slow.json")
    ends[0] = False
    """, "ms.check('slow.json')"),
    "python in landmarks": (1, SLOW + """
    ends[0] = False
    """, "ms.landmarks([(mesh, [1, 50, 100])], methods=['slow'])"),
    "python in a hierarchy's document": (1, SLOW + """
    g = ms.mean_curvature(mesh).apply("slow")
    levels = ms.hierarchy(g, by="iteration", levels=[1])
    ends[0] = False
    """, "levels.save('levels.json')")}


@pytest.mark.parametrize("what", list(WORK))
def test_control_c(what, tmp_path):
    pieces, define, work = WORK[what]
    mesh = sample("lion-head.off" if pieces > 1 else "eight.off")
    define = textwrap.dedent(define).strip().replace("{mesh!r}", repr(mesh))
    source = textwrap.dedent(SCRIPT).format(mesh=mesh, pieces=pieces, define=define, work=work)
    with subprocess.Popen([sys.executable, "-c", source], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True, cwd=tmp_path,
                          preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler)
                          ) as process:
        assert process.stdout.readline() == "ready\n", process.stderr.read()
        time.sleep(1.5)
        assert process.poll() is None
        start = time.monotonic()
        process.send_signal(signal.SIGINT)
        assert process.stdout.readline() == "interrupted\n", process.stderr.read()
        seconds = time.monotonic() - start
        assert process.wait(60) == 0
    # Within a second where a processor is free; a busy machine gets more.
    assert seconds < (1 if os.getloadavg()[0] < 0.5 * len(os.sched_getaffinity(0)) else 20), seconds


LAST = """
    import threading, time
    import numpy as np
    import morsel as ms
    mesh = ms.read({mesh!r}).subdivided(3)
    f = ms.field(mesh, np.sin(np.arange(mesh.vertex_count) % 1000))

    @ms.method("endless")
    def endless(f):
        while True:
            time.sleep(0.001)

    threading.Thread(target=lambda: {work}, daemon=True).start()
    time.sleep(1)
    print("main ends", flush=True)
"""


@pytest.mark.parametrize("work", [
    "ms.salient(f, iterations=100000, sigma='8eps')",
    "ms.salient(f, iterations=100000, sigma='8eps', progress=lambda step, fraction: None)",
    "ms.salient(f, iterations=100000, sigma='8eps', on_iteration=lambda number, field: None)",
    "endless(f)", "ms.compare(f, methods=['endless'])",
    "ms.landmarks([(mesh, [1, 50, 100])], methods=['endless'])"])
def test_a_thread_that_computes_when_the_interpreter_ends(work):
    source = textwrap.dedent(LAST).format(mesh=sample("lion-head.off"), work=work)
    run = subprocess.run([sys.executable, "-c", source], capture_output=True, text=True, check=False,
                         timeout=120)
    assert (run.returncode, run.stdout) == (0, "main ends\n"), run.stderr


def test_threads():
    usual = ms.thread_count()
    with ms.threads(3):
        assert ms.thread_count() == 3
        with ms.threads(2):
            assert ms.thread_count() == 2
            with ms.threads(5):
                assert ms.thread_count() == 2
        assert ms.thread_count() == 3
    assert ms.thread_count() == usual
    for wrong in (0, -1):
        with pytest.raises(ms.ArgumentError):
            with ms.threads(wrong):
                pass
    with pytest.raises(TypeError):
        ms.threads("many")
    assert ms.thread_count() == usual
    limit = ms.threads(2)
    with limit:
        with pytest.raises(ms.ArgumentError):
            with limit:
                pass
    assert ms.thread_count() == usual


def test_importing_is_light():
    source = """if True:
        import sys, numpy
        def libraries():
            return {line.split()[-1] for line in open("/proc/self/maps") if ".so" in line}
        before, loaded = set(sys.modules), libraries()
        import morsel
        made = set(sys.modules) - before
        for heavy in ("matplotlib", "pandas", "networkx", "vtkmodules", "IPython", "tempfile", "html",
                      "morsel._documents", "morsel._molecule"):
            assert heavy not in made, heavy
        for heavy in ("libcrypto", "libopenvdb", "libcairo", "libembree"):
            assert not any(heavy in library for library in libraries() - loaded), heavy
        print(len(made))
    """
    run = subprocess.run([sys.executable, "-c", source], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr


def test_no_source_is_long():
    sources = pathlib.Path(os.environ["MORSEL_SOURCES"]) / "python"
    for path in sorted(sources.rglob("*")):
        if path.suffix in (".cpp", ".h", ".py"):
            assert len(path.read_text().splitlines()) <= 400, path
