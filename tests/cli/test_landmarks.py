"""morsel landmarks: scores on marks made by construction, its files, bad lists, interruptions."""

import csv
import json
import math
import os
import signal
import unittest

import bodies
import jsonschema
from support import DAMAGED, OCTAHEDRON, SAMPLES, SCHEMA, ProgramTest, interrupted, made_in, read_csv

LANDMARKS_SCHEMA = SCHEMA.parent / "landmarks.schema.json"
TIPS = ((1, 0, 0), (0, 1, 0), (0, -0.6, 0.8), (-0.8, 0, -0.6), (0, -0.8, -0.6), (-0.6, 0, 0.8))
MAXIMA = ("--kind", "maxima")


def body(rounds, turn=0.0, scale=1.0):
    """A ball with a bump at each of TIPS, turned and scaled, and the vertices at the tips."""
    directions, triangles = bodies.ball(rounds)

    def place(p):
        height = 1 + sum(0.5 * math.exp(-math.dist(p, tip) ** 2 / 0.08) for tip in TIPS)
        return bodies.turned([scale * height * x for x in p], turn)

    return [place(p) for p in directions], triangles, bodies.nearest(directions, TIPS)


class Landmarks(ProgramTest):
    def setUp(self):
        super().setUp()
        self.marks = []
        for name, arguments in (("coarse", (3,)), ("fine", (4,)), ("turned", (4, 1.0, 7.0))):
            points, triangles, marks = body(*arguments)
            self.file(f"{name}.off", bodies.off(points, triangles))
            self.file(f"{name}.vts", "".join(f"{v}\n" for v in marks))
            self.marks.append(marks)
        self.list = self.file("list.txt", "# three bodies\n" + "".join(
            f"{name}.off {name}.vts\n" for name in ("coarse", "fine", "turned")))

    def landmarks(self, *arguments, name="l.json", listed=None):
        self.morsel("landmarks", listed or self.list, *arguments, "-o", name)
        document = json.loads((self.folder / name).read_text())
        jsonschema.validate(document, json.loads(LANDMARKS_SCHEMA.read_text()))
        return document


class Results(Landmarks):
    def test_the_landmark_field_finds_the_tips(self):
        document = self.landmarks(*MAXIMA)
        self.assertEqual([row["row"] for row in document["rows"]],
                         ["gaussian-curvature:estimator=diffused", "random", "farthest points"])
        found, chance, _ = document["rows"]
        for what in ("recall", "precision", "f_score"):
            self.assertEqual(found[what], {"mean": 1, "interval": [1, 1]})
            self.assertEqual(found["one_to_one"][what]["mean"], 1)
            self.assertLess(chance[what]["mean"], 0.4)
        self.assertEqual(found["false_negatives"]["mean"], 0)
        self.assertLess(chance["f_score_gain"]["interval"][1], -0.5)
        for mesh, marks in zip(document["meshes"], self.marks):
            self.assertEqual((mesh["marked"], mesh["wanted"]), (6, 6))
            self.assertEqual(len(mesh["rows"][0]["points"]), 6)
            self.assertTrue(set(mesh["rows"][0]["points"]) & set(marks))
            self.assertAlmostEqual(mesh["radius"], 0.05 * mesh["mesh"]["bbox_diagonal"])

    def test_the_marks_themselves_score_perfectly_whatever_the_radius(self):
        """Points that are written by morsel points are marks, too."""
        self.morsel("points", "fine.off", *MAXIMA, "--points", 4, "--fill", "none", "-o", "p.csv")
        listed = self.file("own.csv", "mesh,marks\nfine.off,p.csv\n")
        document = self.landmarks("--radius", 0, *MAXIMA, listed=listed)
        self.assertEqual(document["rows"][0]["f_score"], {"mean": 1, "interval": None})
        self.assertEqual(document["rows"][0]["within"]["false_positives"], [0] * 25)
        self.assertEqual(document["meshes"][0]["rows"][0]["points"],
                         [int(row["vertex"]) for row in read_csv(self.folder / "p.csv")])

    def test_figures_are_consistent(self):
        document = self.landmarks("--field", "mean-curvature", "--field", "height", "--method",
                                  "conventional", "--method", "gaussian:iterations=2", "--points", 12,
                                  "--rank", "salience")
        self.assertEqual(len(document["rows"]), 6)
        for number, row in enumerate(document["rows"]):
            results = [mesh["rows"][number] for mesh in document["meshes"]]
            for what in ("recall", "precision", "f_score", "false_negatives", "false_positives"):
                mean = sum(result[what] for result in results) / len(results)
                self.assertAlmostEqual(row[what]["mean"], mean)
                low, high = row[what]["interval"]
                self.assertLessEqual(low, mean + 1e-12)
                self.assertGreaterEqual(high, mean - 1e-12)
            for result, mesh in zip(results, document["meshes"]):
                self.assertEqual(len(result["sets"]), 10 if row["row"] == "random" else 1)
                for counts in result["sets"]:
                    self.assertEqual(counts["detected_within"], sorted(counts["detected_within"]))
                    self.assertEqual(counts["detected_within"][10], counts["detected"])  # 5 % of 12 %
                if len(result["sets"]) > 1:
                    continue
                counts, = result["sets"]
                recall = counts["marks_hit"] / mesh["marked"]
                precision = counts["points_hit"] / counts["points"]
                self.assertAlmostEqual(result["recall"], recall)
                self.assertAlmostEqual(result["precision"], precision)
                if recall + precision > 0:
                    self.assertAlmostEqual(result["f_score"], 2 * recall * precision / (recall + precision))
                self.assertAlmostEqual(result["one_to_one"]["f_score"],
                                       2 * counts["matched"] / (mesh["marked"] + counts["points"]))
                self.assertAlmostEqual(result["false_negatives"], 1 - counts["detected"] / mesh["marked"])
                self.assertAlmostEqual(result["false_positives"], 1 - counts["detected"] / counts["points"])

    def test_the_table_and_what_is_said(self):
        result = self.morsel("landmarks", self.list, "--field", "height", "--field", "mean-curvature",
                             "--points", 40)
        self.assertIn("3 meshes, 18 marks; 40 points on each mesh", result.stdout)
        rows = [line for line in result.stdout.splitlines() if line.startswith(("height", "random"))]
        self.assertEqual(len(rows), 2)
        self.assertIn("height has fewer points than wanted on 3 of 3 meshes (", result.stderr)

    def test_vertices_have_the_numbers_of_the_file(self):
        self.file("d.off", DAMAGED)
        self.file("d.txt", "0 2")
        one = self.file("one", "d.off d.txt")
        document = self.landmarks("--repair", "--field", "height:axis=x", "--spacing", 0, "--kind", "all",
                                  listed=one)
        self.assertEqual(document["meshes"][0]["mesh"]["repairs"][0]["action"], "removed_degenerate_faces")
        self.assertTrue(set(document["meshes"][0]["rows"][0]["points"]) <= {0, 2, 3, 4})
        self.file("d.txt", "1")
        error = self.morsel("landmarks", one, "--repair", code=3).stderr
        self.assertIn("d.txt, line 1: vertex 1 is used by no face", error)
        self.file("d.txt", "1 3")  # from 1
        again = self.landmarks("--repair", "--first", 1, "--field", "height:axis=x", "--spacing", 0, "--kind",
                               "all", listed=one)
        self.assertEqual(again["rows"], document["rows"])


class Files(Landmarks):
    def test_the_schema_refuses_what_it_should(self):
        schema = json.loads(LANDMARKS_SCHEMA.read_text())
        for spoil in (lambda d: d.update(schema="morsel.landmarks/2"), lambda d: d.pop("matching"),
                      lambda d: d["rows"][0].pop("field"), lambda d: d["rows"][1].update(chance="dice"),
                      lambda d: d["rows"][0].pop("f_score_gain"), lambda d: d["meshes"].clear(),
                      lambda d: d["meshes"][0]["rows"][0]["sets"][0].pop("matched"),
                      lambda d: d["meshes"][0]["rows"][0].update(recall=2),
                      lambda d: d["meshes"][0].update(seconds=1)):
            document = self.landmarks("--field", "height")
            spoil(document)
            with self.assertRaises(jsonschema.ValidationError):
                jsonschema.validate(document, schema)

    def test_csv_says_what_json_says(self):
        asked = ("--field", "height", "--field", "mean-curvature", "--seed", 7)
        document = self.landmarks(*asked)
        self.morsel("landmarks", self.list, *asked, "-o", "l.CSV")
        with open(self.folder / "l.CSV", newline="") as file:
            rows = list(csv.DictReader(file))
        expected = [(mesh, row) for mesh in document["meshes"] for row in mesh["rows"]]
        self.assertEqual(len(rows), len(expected))
        for row, (mesh, result) in zip(rows, expected):
            self.assertEqual((row["version"], row["seed"]), (document["tool"]["version"], "7"))
            self.assertEqual((row["mesh"], row["sha256"]), (mesh["mesh"]["path"], mesh["mesh"]["sha256"]))
            self.assertEqual((row["marks_file"], row["marks_sha256"]),
                             (mesh["marks"]["path"], mesh["marks"]["sha256"]))
            self.assertEqual(row["field"], result["row"])
            self.assertEqual(row["method_parameters"] == "", "method" not in result)
            self.assertEqual((int(row["marks"]), int(row["wanted"])), (mesh["marked"], mesh["wanted"]))
            for what in ("recall", "precision", "f_score", "false_negatives", "false_positives"):
                self.assertEqual(float(row[what]), result[what])
            for what, value in result["one_to_one"].items():
                self.assertEqual(float(row["matched_" + what]), value)

    def test_the_same_bytes_at_any_number_of_threads_but_for_timings(self):
        documents, tables, files = [], [], []
        for threads in (1, 2, 5):
            document = self.landmarks(*MAXIMA, "--threads", threads)
            del document["timings"]
            documents.append(document)
            tables.append(self.morsel("landmarks", self.list, *MAXIMA, "--threads", threads, "-o", "l.csv",
                                      "--figures", f"plots{threads}").stdout)
            files.append((self.folder / "l.csv").read_bytes())
            files.append([path.read_bytes() for path in made_in(self.folder / f"plots{threads}")])
        for each in (documents, tables, files[::2], files[1::2]):
            self.assertEqual(each[0], each[1])
            self.assertEqual(each[0], each[2])

    def test_plots(self):
        self.morsel("landmarks", self.list, "--figures", "plots")
        self.assertEqual([path.name for path in made_in(self.folder / "plots")],
                         ["errors.png", "errors.svg", "scores.png", "scores.svg"])
        text = (self.folder / "plots/errors.svg").read_text()
        for words in ("false negatives", "false positives", "radius", "random", "farthest points"):
            self.assertIn(words, text)

    def test_standard_output_and_paths(self):
        os.mkdir(self.folder / "elsewhere")
        result = self.morsel("landmarks", "../list.txt", "--field", "height", "-o", "-",
                             cwd=self.folder / "elsewhere")
        document = json.loads(result.stdout)
        self.assertEqual(document["schema"], "morsel.landmarks/1")
        self.assertEqual(document["meshes"][0]["mesh"]["path"], "coarse.off")

    def test_check_runs_it_again(self):
        self.landmarks("--field", "height", "--points", 5, "--rank", "salience", "--fill", "mean-curvature")
        self.assertEqual(self.morsel("check", "l.json").stdout,
                         f"l.json: unchanged (3 rows on {self.list})\n")
        self.file("fine.vts", "1\n")
        result = self.morsel("check", "--all", "l.json", code=1)
        self.assertIn("meshes[1].marked: 6 -> 1", result.stdout)
        self.list.unlink()
        self.assertIn("list.txt is missing", self.morsel("check", "l.json", code=1).stdout)


class Interruption(Landmarks):
    ARGUMENTS = ("--method", "salient:iterations=200", "--method", "conventional", "--threads", "1")

    def setUp(self):
        super().setUp()
        self.many = self.file("many.txt", "".join(
            f"fine.off {i}.txt\n" for i in range(12)))
        for i in range(12):
            self.file(f"{i}.txt", f"{i} 100 200\n")

    def test_a_run_that_is_ended_in_any_way_goes_on_where_it_was(self):
        whole = self.landmarks(*self.ARGUMENTS, listed=self.many)
        del whole["timings"]
        for how, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGKILL, -signal.SIGKILL)):
            journal = self.folder / "s.json.journal"
            done = interrupted(self.folder, ("landmarks", self.many, *self.ARGUMENTS, "-o", "s.json"), how,
                               code, lambda: journal.exists() and journal.read_bytes().count(b"\n") >= 4)
            self.assertGreaterEqual(done, 3)
            self.assertFalse((self.folder / "s.json").exists())
            result = self.morsel("landmarks", self.many, *self.ARGUMENTS, "-o", "s.json")
            self.assertRegex(result.stderr, r"resuming with [0-9]+ meshes done: s.json.journal")
            document = json.loads((self.folder / "s.json").read_text())
            del document["timings"]
            self.assertEqual(document, whole)
            self.assertFalse(journal.exists())
            (self.folder / "s.json").unlink()


class Refused(Landmarks):
    def refuse(self, *arguments, naming, code=2):
        result = self.morsel("landmarks", self.list, *arguments, code=code)
        for word in naming:
            self.assertIn(word, result.stderr)

    def test_options(self):
        self.refuse("--radius", "far", naming=["--radius", "far"])
        self.refuse("--radius=-2%", naming=["radius of a hit", "-2%"])
        self.refuse("--largest-radius", "0", naming=["largest radius"])
        self.refuse("--points", "0", naming=["--points"])
        self.refuse("--first", "2", naming=["--first"])
        self.refuse("--resamples", "10", naming=["--resamples"])
        self.refuse("--kind", "tips", naming=["tips", "maxima"])
        self.refuse("--spacing=-1%", naming=["spacing"])
        self.refuse("--fill", "nonsense", naming=["nonsense", "height"])
        self.refuse("--method", "nonsense", naming=["nonsense", "salient"])
        self.refuse("--field", "nonsense", naming=["nonsense", "height"])
        self.refuse("--salience-scale", "8eps", naming=["rank=salience"])

    def test_outputs(self):
        self.file("taken", "")
        self.refuse("-o", "l.txt", naming=["l.txt", ".json", ".csv"])
        self.refuse("-o", "taken/l.json", naming=["taken"], code=4)
        self.file("list.csv", "fine.off,fine.csv\n")
        self.file("fine.csv", "1\n")
        for taken in ("list.csv", "fine.csv"):
            error = self.morsel("landmarks", "list.csv", "-o", taken, code=2).stderr
            self.assertIn(f"the output -o {taken} is the file that is read as", error)

    def test_lists(self):
        for text, naming in (("", "lists no mesh"), ("a.off\n", "line 1: a mesh and a file"),
                             ("fine.off absent.txt\n", "absent.txt"),
                             ("fine.off bad.txt\n", "bad.txt, line 2"),
                             ("fine.off empty.txt\n", "empty.txt marks no vertex"),
                             ("fine.off far.txt\n", "far.txt, line 1: there is no vertex 99999"),
                             ("absent.off good.txt\n", "absent.off"), ("good.txt good.txt\n", "good.txt"),
                             ("fine.off good.txt\nfine.off good.txt\n", "line 2")):
            self.file("good.txt", "1 2 3")
            self.file("bad.txt", "1\nx\n")
            self.file("empty.txt", "# none\n")
            self.file("far.txt", "99999\n")
            self.file("o.off", OCTAHEDRON)
            with self.subTest(text):
                error = self.morsel("landmarks", self.file("bad", text), "-o", "l.json", code=3).stderr
                self.assertIn(naming, error)
        self.morsel("landmarks", "absent", code=3)
        self.morsel("landmarks", ".", code=3)
        self.assertFalse(list(self.folder.glob("l.json*")))

    def test_a_row_that_fails(self):
        error = self.morsel("landmarks", self.list, "--field", "vertex-scalar:property=red", "-o", "l.json",
                            code=3).stderr
        self.assertIn("coarse.off: vertex-scalar:property=red: ", error)
        self.assertFalse(list(self.folder.glob("l.json*")))

    def test_a_sample_mesh_with_a_boundary(self):
        self.file("lion.txt", "0 1000 2000")
        listed = self.file("lion", f"\"{SAMPLES / 'lion-head.off'}\" lion.txt")
        document = self.landmarks("--figures", "plots", listed=listed)
        self.assertEqual(document["meshes"][0]["marked"], 3)
        self.assertIsNone(document["rows"][0]["f_score"]["interval"])


if __name__ == "__main__":
    unittest.main()
