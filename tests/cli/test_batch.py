"""morsel batch: collections."""

import csv
import json
import os
import shutil
import signal
import struct
import subprocess
import time
import unittest

import jsonschema

from support import OCTAHEDRON, PROGRAM, SAMPLES, SCHEMA, ProgramTest, until

BATCH_SCHEMA = SCHEMA.parent / "batch.schema.json"
QUICK = ("--method", "conventional", "--method", "salient:iterations=2")
LONG = ("--method", "salient:iterations=1000000", "--no-thumbnails")  # hours


def without_timings(path):
    """The bytes of a file of OUT; of a JSON document, all but its times."""
    if path.suffix != ".json":
        return path.read_bytes()
    document = json.loads(path.read_text())
    document.pop("timings", None)
    document.pop("seconds", None)  # of a state
    return json.dumps(document)


def contents(folder):
    return {str(path.relative_to(folder)): without_timings(path)
            for path in sorted(folder.rglob("*")) if path.is_file() and path.name != ".morsel-results"}


class BatchTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.meshes = self.folder / "meshes"
        (self.meshes / "deeper").mkdir(parents=True)
        self.octahedron = self.file("meshes/octahedron.off", OCTAHEDRON)
        shutil.copy(SAMPLES / "sphere.off", self.meshes)
        shutil.copy(SAMPLES / "anchor.off", self.meshes / "deeper" / "an anchor.off")
        self.file("meshes/notes.txt", "no mesh")
        self.out = self.folder / "out"

    names = ["deeper/an anchor.off", "octahedron.off", "sphere.off"]

    def batch(self, *arguments, out="out", code=0, collection="meshes", pictures=False):
        """Most tests omit pictures, which take longest."""
        return self.morsel_batch(collection, "--out", out, *QUICK, *([] if pictures else ["--no-thumbnails"]),
                                 *arguments,
                                 code=code)

    def morsel_batch(self, *arguments, code=0):
        """As morsel(), but a batch of which a mesh failed writes to both streams."""
        return self.morsel("batch", *arguments, code=code)

    def summary(self, out="out"):
        document = json.loads((self.folder / out / "summary.json").read_text())
        jsonschema.validate(document, json.loads(BATCH_SCHEMA.read_text()))
        return document

    def statuses(self, out="out"):
        return {mesh["name"]: mesh["status"] for mesh in self.summary(out)["meshes"]}

    def rows(self, out="out"):
        with open(self.folder / out / "summary.csv", newline="", encoding="utf-8") as table:
            return list(csv.DictReader(table))

    def times(self):
        return {path: path.stat().st_mtime_ns for folder in ("reports", "state", "thumbnails")
                for path in (self.out / folder).rglob("*") if path.is_file()}

    def rerun(self, before):
        """The meshes whose reports were written since."""
        now = self.times()
        return sorted(str(path.relative_to(self.out / "reports"))[:-len(".json")] for path in now
                      if path.is_relative_to(self.out / "reports") and now[path] != before.get(path))


class Results(BatchTest):
    def test_a_folder_gives_a_report_a_mesh_and_a_summary(self):
        result = self.batch(pictures=True)
        self.assertIn("3 meshes: 3 done, 0 failed", result.stdout)
        self.assertEqual(self.statuses(), dict.fromkeys(self.names, "done"))
        schema = json.loads(SCHEMA.read_text())
        rows = self.rows()
        self.assertEqual([(row["mesh"], row["method"]) for row in rows],
                         [(name, method) for name in self.names for method in QUICK[1::2]])
        for mesh in self.summary()["meshes"]:
            report = json.loads((self.out / mesh["report"]).read_text())
            jsonschema.validate(report, schema)
            self.assertEqual(report["mesh"]["sha256"], mesh["sha256"])
            for i, method in enumerate(report["methods"]):
                row = next(r for r in rows if r["mesh"] == mesh["name"] and r["method"] == QUICK[2 * i + 1])
                self.assertEqual(row["status"], "done")
                self.assertEqual(row["sha256"], mesh["sha256"])
                for key, count in method["critical_points"].items():
                    self.assertEqual(int(row[key]), count)
                self.assertEqual(int(row["pairs"]), method["persistence"]["pairs"])
                self.assertEqual(int(row["pairs_over_1_percent"]), method["persistence"]["above"][1]["pairs"])
                self.assertEqual(mesh["methods"][i]["parameters"], method["parameters"])
            for picture in mesh["thumbnails"]:
                self.assertTrue((self.out / picture).read_bytes().startswith(b"\x89PNG"))
        page = (self.out / "index.html").read_text()
        self.assertIn('href="reports/deeper/an%20anchor.off.json"', page)
        for plot in ("histogram", "cumulative", "against-size"):
            self.assertIn(f'src="plots/{plot}.svg"', page)
        self.assertNotIn("http", page)

    def test_a_report_is_that_of_compare(self):
        self.batch("--snap", "--no-items", "--target", "8", "--field", "height:axis=x")
        self.morsel("compare", "meshes/sphere.off", *QUICK, "--snap", "--no-items", "--target", "8",
                    "--field",
                    "height:axis=x", "-o", "alone.json")
        self.assertEqual(without_timings(self.out / "reports/sphere.off.json"),
                         without_timings(self.folder / "alone.json"))

    def test_a_list_gives_the_same_as_the_folder_in_its_own_order(self):
        self.file("meshes/list.txt", "# three\nsphere.off\r\n\ndeeper/an anchor.off\noctahedron.off\n")
        self.batch()
        self.batch(out="listed", collection="meshes/list.txt")
        self.assertEqual([mesh["name"] for mesh in self.summary("listed")["meshes"]],
                         ["sphere.off", "deeper/an anchor.off", "octahedron.off"])
        for folder in ("reports", "thumbnails", "state"):
            self.assertEqual(contents(self.out / folder), contents(self.folder / "listed" / folder))

    def test_jobs_and_threads_change_nothing(self):
        self.batch("--jobs", "1")
        self.batch("--jobs", "3", "--threads", "2", out="other")
        self.assertEqual(contents(self.out), contents(self.folder / "other"))

    def test_timings_come_when_asked_for(self):
        self.batch()
        self.assertNotIn("seconds", self.rows()[0])
        self.batch("--with-timings")
        self.assertGreaterEqual(float(self.rows()[0]["seconds"]), 0)
        self.assertFalse((self.out / "thumbnails").exists())


class Again(BatchTest):
    def test_what_is_done_is_not_done_again(self):
        self.batch(pictures=True)
        before, files = self.times(), contents(self.out)
        result = self.batch(pictures=True)
        self.assertIn("(3 by earlier runs)", result.stdout)
        self.assertEqual(self.times(), before)
        self.assertEqual(contents(self.out), files)

    def test_what_changed_is_done_again_and_nothing_else(self):
        self.batch()
        before = self.times()
        self.octahedron.write_text(OCTAHEDRON.replace("0 0 1\n", "0 0 2\n", 1))
        self.batch()
        self.assertEqual(self.rerun(before), ["octahedron.off"])

        before = self.times()
        os.utime(self.octahedron)  # the same bytes
        self.batch()
        self.assertEqual(self.rerun(before), [])

        (self.out / "reports/sphere.off.json").unlink()
        self.batch()
        self.assertEqual(self.rerun(before), ["sphere.off"])

        before = self.times()
        self.file("meshes/new.off", OCTAHEDRON)
        self.batch()
        self.assertEqual(self.rerun(before), ["new.off"])

        before = self.times()
        self.batch("--snap")
        self.assertEqual(len(self.rerun(before)), 4)

    def test_a_changed_file_of_an_option_is_a_change(self):
        values = self.file("values.txt", "".join(f"{i}\n" for i in range(6)))
        self.file("list", "meshes/octahedron.off\n")
        arguments = ("--field", "vertex-scalar:file=values.txt")
        self.batch(*arguments, collection="list")
        before = self.times()
        self.batch(*arguments, collection="list")
        self.assertEqual(self.rerun(before), [])
        values.write_text("".join(f"{i * i}\n" for i in range(6)))
        self.batch(*arguments, collection="list")
        self.assertEqual(self.rerun(before), ["meshes/octahedron.off"])

    def test_a_collection_piece_by_piece_is_the_whole(self):
        self.batch()
        for name in self.names:
            self.batch("--only", name, "--no-summary", out="pieces")
            self.assertFalse((self.folder / "pieces/summary.json").exists())
        self.assertIn("(3 by earlier runs)", self.batch(out="pieces").stdout)
        self.assertEqual(contents(self.folder / "pieces"), contents(self.out))

    def test_a_plan_names_what_a_run_would_work_on(self):
        self.file("meshes/bad.off", "OFF\n")
        sizes = {name: (self.meshes / name).stat().st_size for name in ("bad.off", *self.names)}

        def plan(*arguments):
            lines = self.batch("--plan", *arguments).stdout.splitlines()
            return {name: int(size) for size, name in (line.split("\t") for line in lines)}
        self.assertEqual(plan(), sizes)
        self.assertEqual(contents(self.out), {})
        self.batch("--only", "sphere.off", "--only", "bad.off", "--no-summary", code=1)
        before = contents(self.out)
        rest = {name: sizes[name] for name in self.names if name != "sphere.off"}
        self.assertEqual(plan(), rest)
        self.assertEqual(plan("--retry"), {**rest, "bad.off": sizes["bad.off"]})
        self.assertEqual(plan("--snap"), sizes)
        self.assertEqual(plan("--only", "sphere.off"), {})
        self.assertEqual(contents(self.out), before)

    def test_the_summary_tells_what_was_not_run(self):
        self.batch("--only", "sphere.off")
        self.assertEqual(self.statuses(), {**dict.fromkeys(self.names, "not-run"), "sphere.off": "done"})
        self.assertIn("1 done, 0 failed, 2 not run", self.batch("--summary-only", code=1).stdout)
        self.batch("--snap", "--summary-only", code=1)
        self.assertEqual(set(self.statuses().values()), {"not-run"})


class Failures(BatchTest):
    def morsel_batch(self, *arguments, code=0):
        result = subprocess.run([PROGRAM, "batch", *map(str, arguments)], capture_output=True, text=True,
                                timeout=240,
                                cwd=self.folder, check=False)
        self.assertEqual(result.returncode, code, result.stderr)
        return result

    def error(self, name):
        return next(mesh for mesh in self.summary()["meshes"] if mesh["name"] == name)["error"]

    def test_a_bad_mesh_does_not_stop_the_others(self):
        self.file("meshes/bad.off", "OFF\n3 1 0\nnothing, \"really\"\n")
        self.file("meshes/list", "bad.off\nabsent.off\nsphere.off\n")
        result = self.batch(collection="meshes/list", code=1)
        self.assertIn("1 done, 2 failed", result.stdout)
        self.assertEqual(self.statuses(), {"bad.off": "failed", "absent.off": "failed", "sphere.off": "done"})
        error = self.error("bad.off")
        self.assertEqual((error["kind"], error["exit_code"], error["signal"]), ("exit-code", 3, None))
        self.assertIn("line 3", error["message"])
        self.assertIsNone(next(m for m in self.summary()["meshes"] if m["name"] == "absent.off")["sha256"])
        row = self.rows()[0]
        self.assertEqual((row["status"], row["total"], row["error"]), ("failed", "", error["message"]))
        self.assertIn("absent.off", (self.out / "index.html").read_text())
        # it is not run again until it changes
        self.assertIn("(3 by earlier runs)", self.batch(collection="meshes/list", code=1).stdout)
        self.assertIn("(1 by earlier runs)", self.batch("--retry", collection="meshes/list", code=1).stdout)
        for name in ("bad.off", "absent.off"):
            self.file(f"meshes/{name}", OCTAHEDRON)
        self.batch(collection="meshes/list")

    def test_a_mesh_that_becomes_bad_loses_its_report(self):
        self.batch("--only", "octahedron.off", pictures=True)
        self.assertTrue((self.out / "thumbnails/octahedron.off.first.png").exists())
        self.octahedron.write_text("OFF\n")
        self.batch("--only", "octahedron.off", pictures=True, code=1)
        self.assertFalse((self.out / "reports/octahedron.off.json").exists())
        self.assertFalse((self.out / "thumbnails/octahedron.off.first.png").exists())

    def test_a_time_limit(self):
        begin = time.monotonic()
        self.morsel_batch("meshes", "--out", "out", "--time-limit", "0.5", *LONG, "--only", "sphere.off",
                          code=1)
        self.assertLess(time.monotonic() - begin, 20)
        self.assertEqual(self.error("sphere.off"), {"kind": "time-limit", "exit_code": None, "signal": 9,
                                                    "message": "longer than the time limit of 0.5 s"})
        again = self.morsel_batch("meshes", "--out", "out", "--time-limit", "0.5", *LONG, "--only",
                                  "sphere.off", code=1)
        self.assertIn("(1 by earlier runs)", again.stdout)
        other = self.morsel_batch("meshes", "--out", "out", "--time-limit", "0.6", *LONG, "--only",
                                  "sphere.off", code=1)
        self.assertNotIn("earlier", other.stdout)

    @unittest.skipIf(os.environ.get("ASAN_OPTIONS") or os.environ.get("TSAN_OPTIONS"),
                     "sanitizers take memory themselves")
    def test_a_memory_limit(self):
        width, height = 500, 1000
        vertices = (struct.pack("<3f", x, y, (x * x + y) % 7) for y in range(height) for x in range(width))
        corners = (y * width + x for y in range(height - 1) for x in range(width - 1))
        faces = (struct.pack("<B3iB3i", 3, i, i + 1, i + width, 3, i + 1, i + width + 1, i + width)
                 for i in corners)
        header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {width * height}\n"
                  "property float x\nproperty float y\nproperty float z\n"
                  f"element face {2 * (width - 1) * (height - 1)}\nproperty list uchar int vertex_indices\n"
                  "end_header\n")
        (self.meshes / "large.ply").write_bytes(header.encode() + b"".join(vertices) + b"".join(faces))
        self.batch("--memory-limit", "120", code=1)
        self.assertEqual(self.statuses(), {**dict.fromkeys(self.names, "done"), "large.ply": "failed"})
        error = self.error("large.ply")
        self.assertEqual((error["kind"], error["message"]), ("memory-limit",
                                                             "more memory than the limit of 120 MiB"))


class AtWork(BatchTest):
    """Tests of the processes of meshes in work."""

    def children(self):
        return [pid for pid in os.listdir("/proc") if pid.isdigit() and self.is_child(pid)]

    def is_child(self, pid):
        try:
            with open(f"/proc/{pid}/cmdline", "rb") as words, open(f"/proc/{pid}/stat",
                                                                   encoding="utf-8") as stat:
                return (b"compare" in words.read()
                        and os.readlink(f"/proc/{pid}/cwd") == str(self.folder.resolve())
                        and ") Z " not in stat.read())
        except OSError:
            return False


class Interruptions(AtWork):
    def started(self):
        """A batch whose meshes are done but for one, which it works on."""
        self.file("list", "meshes/octahedron.off\nmeshes/deeper/an anchor.off\nmeshes/sphere.off\n")
        return subprocess.Popen([PROGRAM, "batch", "list", "--out", "out", "--jobs", "1", *self.arguments],
                                cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    # long enough, on all meshes but the first, to be found at work
    arguments = ("--method", "conventional", "--method", "salient:iterations=1500", "--no-thumbnails")

    def test_no_process_is_left_when_the_run_has_ended(self):
        self.arguments = LONG
        for how in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            with self.started() as process:
                until(self.children)
                process.send_signal(how)
                process.communicate(timeout=60)
            until(lambda: not self.children(), 10)

    def test_a_run_that_is_ended_in_any_way_can_be_completed(self):
        whole = None
        for how, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGKILL, -signal.SIGKILL)):
            shutil.rmtree(self.out, ignore_errors=True)
            with self.started() as process:
                until(lambda: (self.out / "state/meshes/octahedron.off.json").exists()
                           and (self.out / "work").exists() and self.children())
                process.send_signal(how)
                process.communicate(timeout=60)
            self.assertEqual(process.returncode, code)
            until(lambda: not self.children(), 10)
            self.assertEqual(sorted(path.name for path in (self.out / "reports").rglob("*.json")),
                             ["octahedron.off.json"])
            json.loads((self.out / "reports/meshes/octahedron.off.json").read_text())
            if how != signal.SIGKILL:  # then not even what is not whole is left
                self.assertEqual([path for path in self.out.rglob("*") if path.suffix == ".tmp"
                                  or path.name == "work"], [])
            before = self.times()
            result = self.morsel("batch", "list", "--out", "out", *self.arguments)
            self.assertIn("3 done, 0 failed (1 by earlier runs)", result.stdout)
            self.assertEqual(self.rerun(before), ["meshes/deeper/an anchor.off", "meshes/sphere.off"])
            if whole is None:
                self.morsel("batch", "list", "--out", "whole", *self.arguments)
                whole = contents(self.folder / "whole")
            self.assertEqual(contents(self.out), whole)


class WrongInput(BatchTest):
    def test_what_cannot_begin_is_refused_in_one_sentence(self):
        (self.folder / "empty").mkdir()
        for wrong, code, said in ((("empty",), 3, "no mesh"),
                                  (("absent",), 3, "absent"),
                                  ((self.file("list", "# nothing\n"),), 3, "no mesh in the list"),
                                  ((self.file("twice", "meshes/sphere.off\n./meshes/sphere.off\n"),), 3,
                                   "two meshes"),
                                  (("meshes/sphere.off",), 3, "is a mesh"),
                                  (("meshes", "--method", "nonsense"), 2, "nonsense"),
                                  (("meshes", "--field", "height:axes=z"), 2, "axes"),
                                  (("meshes", "--only", "absent.off"), 2, "absent.off"),
                                  (("meshes", "--time-limit", "0"), 2, "time-limit"),
                                  (("meshes", "--jobs", "0"), 2, "jobs"),
                                  (("meshes", "--memory-limit", "63"), 2, "memory-limit"),
                                  (("meshes", "--no-summary", "--summary-only"), 2, "summary"),
                                  (("meshes", "--plan", "--summary-only"), 2, "plan"),
                                  (("meshes", "--nonsense"), 2, "nonsense")):
            with self.subTest(wrong=wrong):
                self.assertIn(said, self.morsel("batch", *wrong, "--out", "out", code=code).stderr)
                self.assertEqual(contents(self.out), {})
        self.assertIn("out", self.morsel("batch", "meshes", code=2).stderr)
        for place in (self.file("file", ""), "file/deeper", "/proc/nowhere"):
            self.assertIn(str(place), self.morsel("batch", "meshes", "--out", place, code=4).stderr)


if __name__ == "__main__":
    unittest.main()
