"""morsel sweep: every combination of some parameters' values, its files, its plots and its errors."""

import csv
import hashlib
import json
import os
import signal
import unittest

import jsonschema
from support import DAMAGED, OCTAHEDRON, SAMPLES, SCHEMA, ProgramTest, interrupted, made_in

SWEEP_SCHEMA = SCHEMA.parent / "sweep.schema.json"
LION = SAMPLES / "lion-head.off"
SMALL = SAMPLES / "mushroom.off"
GRID = ("--vary", "iterations=0..3", "--vary", "sigma=4eps,8eps")


class Sweep(ProgramTest):
    def sweep(self, *arguments, name="sweep.json"):
        self.morsel("sweep", *arguments, "-o", name)
        return json.loads((self.folder / name).read_text())

    def table(self, name):
        with open(self.folder / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))


class Results(Sweep):
    def test_the_lion_head_by_iterations(self):
        # Reference counts for 1, 5, 10 and 20 iterations.
        document = self.sweep(LION, "--vary", "iterations=1,5..20..5", "--vary", "range=1std,local")
        jsonschema.validate(document, json.loads(SWEEP_SCHEMA.read_text()))
        totals = {(row["values"]["range"], row["values"]["iterations"]): row["critical_points"]["total"]
                  for row in document["rows"]}
        self.assertEqual(len(totals), 10)
        for how, expected in (("1std", (1033, 137, 97, 65)), ("local", (533, 75, 73, 59))):
            for iterations, total in zip(("1", "5", "10", "20"), expected):
                self.assertAlmostEqual(totals[how, iterations], total, delta=max(1, 0.005 * total))

    def test_a_row_is_what_compare_says(self):
        document = self.sweep(SMALL, "--field", "mean-curvature", "--method", "salient+tps", *GRID, "--vary",
                              "threshold=1%,5%")
        self.assertEqual(len(document["rows"]), 16)
        for row in document["rows"][::3]:
            spec = row["specification"]
            report = self.report(SMALL, "--field", spec["field"], "--method", spec["method"], "--no-items")
            method = report["methods"][0]
            self.assertEqual(report["field"], row["field"])
            self.assertEqual(method["critical_points"], row["critical_points"])
            self.assertEqual(method["persistence"], row["persistence"])
            self.assertEqual(method["parameters"], row["method"]["parameters"])

    def test_the_table(self):
        result = self.morsel("sweep", SMALL, *GRID)
        lines = result.stdout.splitlines()
        self.assertEqual(lines[0].split()[:3], ["iterations", "sigma", "minima"])
        self.assertEqual(len(lines), 2 + 8)
        self.assertEqual(lines[2].split()[:2], ["0", "4eps"])


class Files(Sweep):
    def test_documents_follow_the_schema(self):
        schema = json.loads(SWEEP_SCHEMA.read_text())
        mesh = self.file("o.off", OCTAHEDRON)
        values = self.file("values.txt", "1\n2\n3\n4\n5\n6\n")
        for arguments in ([mesh, "--field", "height", "--vary", "axis=x,y,z", "--method", "conventional"],
                          [mesh, "--field", "vertex-scalar", "--method", "tps", "--vary", f"file={values}"],
                          [self.file("d.off", DAMAGED), "--repair", "--method", "gaussian+laplacian",
                           "--field",
                           "height", "--vary", "2.iterations=1,2"]):
            jsonschema.validate(self.sweep(*arguments), schema)
        for spoil in (lambda d: d.update(schema="morsel.sweep/2"), lambda d: d.pop("mesh"),
                      lambda d: d["rows"][0].pop("values"),
                      lambda d: d["rows"][0]["critical_points"].pop("total"),
                      lambda d: d["timings"]["rows"][0].update(field=-1)):
            document = self.sweep(mesh, "--field", "height", "--vary", "iterations=1")
            spoil(document)
            with self.assertRaises(jsonschema.ValidationError):
                jsonschema.validate(document, schema)

    def test_files_that_values_name_are_hashed(self):
        mesh = self.file("o.off", OCTAHEDRON)
        values = self.file("values.txt", "1\n2\n3\n4\n5\n6\n")
        document = self.sweep(mesh, "--field", "vertex-scalar", "--method", "tps", "--vary", f"file={values}")
        self.assertEqual(document["rows"][0]["field"]["parameters"]["file_sha256"],
                         hashlib.sha256(values.read_bytes()).hexdigest())

    def test_csv_says_what_json_says(self):
        document = self.sweep(SMALL, *GRID)
        self.morsel("sweep", SMALL, *GRID, "-o", "s.CSV")
        rows = self.table("s.CSV")
        self.assertEqual(len(rows), len(document["rows"]))
        for row, expected in zip(rows, document["rows"]):
            self.assertEqual(row["version"], document["tool"]["version"])
            self.assertEqual(row["sha256"], document["mesh"]["sha256"])
            self.assertEqual((row["field"], row["method"]), tuple(expected["specification"].values()))
            self.assertEqual({key: row[key] for key in ("iterations", "sigma")}, expected["values"])
            for key, count in expected["critical_points"].items():
                self.assertEqual(int(row[key]), count)
            self.assertEqual(int(row["pairs"]), expected["persistence"]["pairs"])
            self.assertEqual(float(row["largest_persistence"]), expected["persistence"]["max"])
            self.assertEqual(int(row["pairs_over_1_percent"]), expected["persistence"]["above"][1]["pairs"])
            self.assertEqual(json.loads(row["method_parameters"]), expected["method"]["parameters"])
            self.assertEqual(int(row["iterations_run"]), expected["iterations_run"])
            self.assertGreaterEqual(float(row["seconds"]), 0)

    def test_the_same_bytes_at_any_number_of_threads_but_for_timings(self):
        documents, tables, plots = [], [], []
        for threads in (1, 2, 5):
            document = self.sweep(SMALL, *GRID, "--threads", threads, "--figures", "plots")
            del document["timings"]
            documents.append(document)
            self.morsel("sweep", SMALL, *GRID, "--threads", threads, "-o", "s.csv")
            tables.append([{key: value for key, value in row.items() if key != "seconds"}
                           for row in self.table("s.csv")])
            plots.append({path.name: path.read_bytes() for path in (self.folder / "plots").glob("[!.]*")})
            self.assertTrue(plots[-1])
        for each in (documents, tables, plots):
            self.assertEqual(each[0], each[1])
            self.assertEqual(each[0], each[2])

    def test_plots(self):
        self.morsel("sweep", SMALL, *GRID, "--vary", "range=local,literal", "--vary", "support=2",
                    "--figures", "plots")
        self.assertEqual([path.name for path in made_in(self.folder / "plots")],
                         [f"{key}.{kind}" for key in ("iterations", "range", "sigma")
                          for kind in ("png", "svg")])
        drawing = (self.folder / "plots/iterations.svg").read_text()
        for text in ("critical points", "iterations", "sigma=8eps, range=literal"):
            self.assertIn(text, drawing)
        self.assertIn(">literal<", (self.folder / "plots/range.svg").read_text())

    def test_standard_output(self):
        result = self.morsel("sweep", self.file("o.off", OCTAHEDRON), "--field", "height", "--vary",
                             "iterations=1..3",
                             "-o", "-")
        self.assertEqual(len(json.loads(result.stdout)["rows"]), 3)


class Interruption(Sweep):
    # Eight rows that take their time one by one: the first step differs.
    ARGUMENTS = (LION, "--method", "salient:iterations=100", "--vary", "sigma=8..15..1eps")

    def test_a_sweep_that_is_ended_in_any_way_goes_on_where_it_was(self):
        whole = self.sweep(*self.ARGUMENTS)
        del whole["timings"]
        for how, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGKILL, -signal.SIGKILL)):
            journal = self.folder / "s.json.journal"
            done = interrupted(self.folder, ("sweep", *self.ARGUMENTS, "-o", "s.json"), how, code,
                               lambda: journal.exists() and journal.read_bytes().count(b"\n") >= 4)
            self.assertGreaterEqual(done, 3)
            self.assertFalse((self.folder / "s.json").exists())
            result = self.morsel("sweep", *self.ARGUMENTS, "-o", "s.json")
            self.assertRegex(result.stderr, r"resuming with [3-7] of 8 combinations done: s.json.journal")
            document = json.loads((self.folder / "s.json").read_text())
            del document["timings"]
            self.assertEqual(document, whole)
            self.assertFalse(journal.exists())
            (self.folder / "s.json").unlink()

    def test_what_is_done_serves_a_larger_sweep_but_no_other_mesh(self):
        journal = self.folder / "s.json.journal"
        interrupted(self.folder, ("sweep", *self.ARGUMENTS, "-o", "s.json"), signal.SIGKILL, -signal.SIGKILL,
                    lambda: journal.exists() and journal.read_bytes().count(b"\n") >= 3)
        kept = journal.read_bytes()
        result = self.morsel("sweep", SMALL, *self.ARGUMENTS[1:], "-o", "s.json")
        self.assertNotIn("going on", result.stderr)
        journal.write_bytes(kept)
        result = self.morsel("sweep", LION, "--method", "salient:iterations=100", "--vary", "sigma=8eps,9eps",
                             "-o",
                             "s.json")
        self.assertIn("resuming with 2 of 2", result.stderr)


class Refused(Sweep):
    def refuse(self, *arguments, naming, code=2):
        result = self.morsel("sweep", LION, *arguments, code=code)
        for word in naming:
            self.assertIn(word, result.stderr)

    def test_options(self):
        self.refuse(naming=["--vary"])
        self.refuse("--vary", "sigma", naming=["sigma", "KEY=VALUE"])
        self.refuse("--vary", "sgima=1,2", naming=["sgima", "sigma"])
        self.refuse("--vary", "scale=1,2", naming=["field.scale", "salient.scale"])
        self.refuse("--vary", "sigma=0,1", naming=["salient:sigma", "0"])
        self.refuse("--vary", "iterations=1..x", naming=["1..x", "range"])
        self.refuse("--method", "salient:sigma=1", "--vary", "sigma=2", naming=["given as 1"])
        self.refuse("--method", "nonsense", "--vary", "sigma=2", naming=["nonsense", "salient"])
        self.refuse("--field", "nonsense", "--vary", "sigma=2", naming=["nonsense", "height"])
        self.refuse("--vary", "sigma=1..3000", "--vary", "support=1..3000", naming=["1000000"])

    def test_files(self):
        self.refuse("--vary", "sigma=1", "-o", "s.txt", naming=["s.txt", ".json", ".csv"])
        self.file("plots", "")
        self.refuse("--vary", "sigma=1", "-o", "plots/s.json", naming=["plots"], code=4)
        self.refuse("--vary", "sigma=1", "--figures", "plots", naming=["plots"], code=4)
        self.morsel("sweep", "absent.off", "--vary", "sigma=1", "-o", "s.json", code=3)
        self.assertEqual(os.listdir(self.folder), ["plots"])  # no half-written document, no journal

    def test_a_combination_that_fails(self):
        result = self.morsel("sweep", self.file("o.off", OCTAHEDRON), "--field", "vertex-scalar", "--method",
                             "tps",
                             "--vary", "file=absent.txt,other.txt", "-o", "s.json", code=3)
        self.assertIn("vertex-scalar:file=absent.txt, tps: ", result.stderr)
        self.assertEqual(os.listdir(self.folder), ["o.off"])


if __name__ == "__main__":
    unittest.main()
