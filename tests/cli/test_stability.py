"""morsel stability: how critical points repeat on perturbed surfaces, its files and its errors."""

import csv
import json
import os
import signal
import unittest

import jsonschema
from support import DAMAGED, OCTAHEDRON, SAMPLES, SCHEMA, ProgramTest, interrupted, made_in

STABILITY_SCHEMA = SCHEMA.parent / "stability.schema.json"
LION = SAMPLES / "lion-head.off"
SMALL = SAMPLES / "mushroom.off"
ALL = ("--noise", "0.1,0.3", "--decimate", "0.8", "--subdivide", "2", "--trials", "2", "--target", "30")


class Stability(ProgramTest):
    def stability(self, *arguments, name="stability.json"):
        self.morsel("stability", *arguments, "-o", name)
        return json.loads((self.folder / name).read_text())

    def f_scores(self, document):
        return {(o["field"], o["method"], o["target"], p["perturbation"], p["amount"]): p["f_score"]["mean"]
                for o in document["outcomes"] for p in o["perturbations"]}


class Results(Stability):
    def test_no_noise_repeats_exactly(self):
        document = self.stability(SMALL, "--noise", "0", "--radius", "0", "--trials", "2")
        self.assertEqual(len(document["outcomes"]), 3)
        for outcome in document["outcomes"]:
            perturbed, = outcome["perturbations"]
            for what in ("recall", "precision", "f_score"):
                self.assertEqual(perturbed[what], {"mean": 1, "deviation": 0, "half_width": 0})
            self.assertEqual(perturbed["drift"]["mean"], 0)
            self.assertLess(perturbed["chance"]["mean"], 1)

    def test_the_lion_head(self):
        document = self.stability(LION, "--method", "conventional", "--method", "laplacian:iterations=30",
                                  "--noise", "0.05,0.3", "--trials", "2", "--target", "148")
        jsonschema.validate(document, json.loads(STABILITY_SCHEMA.read_text()))
        self.assertEqual([(o["target"], o["method"]) for o in document["outcomes"]],
                         [(target, method) for target in (None, 148)
                          for method in ("conventional", "laplacian:iterations=30")])
        raw = document["outcomes"][0]
        self.assertEqual(raw["clean"]["critical_points"]["total"], 1895)
        self.assertEqual((raw["agreement"]["share"], raw["agreement"]["matched"]), (1, 1895))
        self.assertLess(raw["agreement"]["chance"], 0.8)
        for outcome in document["outcomes"][2:]:
            self.assertIn(outcome["clean"]["critical_points"]["total"], (147, 148))
            self.assertEqual(outcome["clean"]["target"]["wanted"], 148)
        f = self.f_scores(document)
        method = "laplacian:iterations=30"
        # At equal counts smoothing repeats better under little noise, and chance is far below.
        self.assertGreater(f["mean-curvature", method, 148, "noise", 0.05],
                           f["mean-curvature", "conventional", 148, "noise", 0.05] + 0.1)
        for outcome in document["outcomes"][2:]:
            for perturbed in outcome["perturbations"]:
                self.assertLess(2 * perturbed["chance"]["mean"], perturbed["f_score"]["mean"])

    def test_figures_are_consistent(self):
        document = self.stability(SMALL, *ALL)
        for outcome in document["outcomes"]:
            clean = outcome["clean"]["points"]
            for perturbed in outcome["perturbations"]:
                self.assertEqual(len(perturbed["runs"]), 1
                                 if perturbed["perturbation"] == "subdivision" else 2)
                for run in perturbed["runs"]:
                    self.assertEqual(run["found"], run["minima"] + run["saddles"] + run["maxima"])
                    self.assertAlmostEqual(run["recall"], run["matched"] / clean)
                    self.assertAlmostEqual(run["precision"], run["matched"] / run["found"])
                    self.assertAlmostEqual(run["f_score"], 2 * run["matched"] / (clean + run["found"]))
                for what in ("recall", "precision", "f_score", "chance"):
                    mean = sum(run[what] for run in perturbed["runs"]) / len(perturbed["runs"])
                    self.assertAlmostEqual(perturbed[what]["mean"], mean)

    def test_fields_side_by_side_with_one_reference(self):
        asked = (SMALL, "--field", "mean-curvature", "--field", "height", "--method", "conventional",
                 "--noise", "0.1", "--trials", "1", "--points", "extrema")
        for outcome in self.stability(*asked)["outcomes"]:
            self.assertEqual(outcome["agreement"]["share"], 1)
        curvature, height = self.stability(*asked, "--reference-field", "mean-curvature")["outcomes"]
        self.assertEqual(curvature["agreement"]["share"], 1)
        self.assertLess(height["agreement"]["share"], 1)
        for outcome in (curvature, height):
            counts = outcome["clean"]["critical_points"]
            self.assertEqual(outcome["clean"]["points"], counts["minima"] + counts["maxima"])

    def test_a_preset_sets_field_and_methods_for_the_wanted_number_of_points(self):
        few = self.stability(SMALL, "--preset", "resampled", "--trials", "1", "--decimate", "0.5", "--target",
                             "20")
        field, = few["request"]["fields"]
        self.assertRegex(field, "^mean-curvature:estimator=diffused,.*diffusion=0.105rootarea")
        self.assertEqual([o["method"] for o in few["outcomes"]], few["request"]["methods"] * 2)
        self.assertEqual(few["request"]["methods"][0], "conventional")
        many = self.stability(SMALL, "--target", "80", "--preset", "resampled", "--trials", "1", "--noise",
                              "0.1")
        self.assertIn("diffusion=0.0525rootarea", many["request"]["fields"][0])
        noise = self.stability(SMALL, "--preset", "noise", "--trials", "1", "--noise", "0.1")
        self.assertEqual(noise["request"]["methods"], ["conventional", "salient", "salient:preset=robust"])

    def test_the_table(self):
        out = self.morsel("stability", SMALL, "--method", "conventional", "--noise", "0.1", "--trials", "2",
                          "--target", "20").stdout
        self.assertIn("2 trials, seed 1", out)
        self.assertIn("Each method's own count", out)
        self.assertIn("Target 20", out)
        row, = [line for line in out.split("Target 20")[1].splitlines() if line.startswith("noise 0.1")]
        self.assertEqual(len(row.split()), 10)

    def test_a_mesh_that_had_to_be_repaired(self):
        document = self.stability(self.file("d.off", DAMAGED), "--repair", "--field", "height", "--noise",
                                  "0.1",
                                  "--subdivide", "3", "--trials", "1")
        self.assertEqual([r["action"] for r in document["mesh"]["repairs"]],
                         ["removed_degenerate_faces", "removed_unreferenced_vertices"])


class Files(Stability):
    def test_documents_follow_the_schema(self):
        schema = json.loads(STABILITY_SCHEMA.read_text())
        mesh = self.file("o.off", OCTAHEDRON)
        for arguments in ([mesh, "--field", "height"], [SMALL, *ALL, "--kind", "isotropic"],
                          [mesh, "--method", "tps:count=9+gaussian:iterations=2,sigma=0.5", "--trials", "1"],
                          [self.file("d.off", DAMAGED), "--repair", "--radius", "4eps", "--points",
                           "extrema"]):
            jsonschema.validate(self.stability(*arguments), schema)

    def test_the_schema_refuses_what_it_should(self):
        schema = json.loads(STABILITY_SCHEMA.read_text())
        mesh = self.file("o.off", OCTAHEDRON)
        for spoil in (lambda d: d.update(schema="morsel.stability/2"), lambda d: d.pop("matching"),
                      lambda d: d["outcomes"][0].pop("target"),
                      lambda d: d["outcomes"][0]["agreement"].update(share=2),
                      lambda d: d["outcomes"][0]["perturbations"][0].update(perturbation="heat"),
                      lambda d: d["outcomes"][0]["perturbations"][0]["runs"][0].pop("chance")):
            document = self.stability(mesh, "--field", "height", "--trials", "1")
            jsonschema.validate(document, schema)
            spoil(document)
            with self.assertRaises(jsonschema.ValidationError):
                jsonschema.validate(document, schema)

    def test_csv_says_what_json_says(self):
        document = self.stability(SMALL, *ALL)
        self.morsel("stability", SMALL, *ALL, "-o", "s.CSV")
        with open(self.folder / "s.CSV", newline="") as file:
            rows = list(csv.DictReader(file))
        expected = [(o, p) for o in document["outcomes"] for p in o["perturbations"]]
        self.assertEqual(len(rows), len(expected))
        for row, (outcome, perturbed) in zip(rows, expected):
            self.assertEqual(row["sha256"], document["mesh"]["sha256"])
            self.assertEqual(row["version"], document["tool"]["version"])
            self.assertEqual(row["seed"], "1")
            self.assertEqual(row["target"], "" if outcome["target"] is None else str(outcome["target"]))
            self.assertEqual(json.loads(row["method_parameters"]), outcome["clean"]["parameters"])
            self.assertEqual((row["method"], row["perturbation"], float(row["amount"])),
                             (outcome["method"], perturbed["perturbation"], perturbed["amount"]))
            for what in ("f_score", "recall", "precision", "drift", "chance"):
                self.assertEqual(float(row[what]), perturbed[what]["mean"])
                half = perturbed[what]["half_width"]
                self.assertEqual(row[what + "_half_width"] == "", half is None)
                if half is not None:
                    self.assertEqual(float(row[what + "_half_width"]), half)

    def test_the_same_bytes_at_any_number_of_threads_but_for_timings(self):
        documents, tables, files, plots = [], [], [], []
        for threads in (1, 2, 5):
            document = self.stability(SMALL, *ALL, "--threads", threads, "--figures", "plots")
            plots.append({path.name: path.read_bytes() for path in made_in(self.folder / "plots")})
            del document["timings"]
            documents.append(document)
            tables.append(self.morsel("stability", SMALL, *ALL, "--threads", threads, "-o", "s.csv").stdout)
            files.append((self.folder / "s.csv").read_bytes())
        for each in (documents, tables, files, plots):
            self.assertEqual(each[0], each[1])
            self.assertEqual(each[0], each[2])

    def test_plots(self):
        self.morsel("stability", SMALL, *ALL, "--method", "conventional", "--method", "gaussian",
                    "--figures", "plots")
        self.assertEqual([path.name for path in made_in(self.folder / "plots")],
                         [f"{over}.{kind}" for over in ("noise", "vertices") for kind in ("png", "svg")])
        for over, unit in (("noise", "mean edge lengths"), ("vertices", "of the clean surface")):
            drawing = (self.folder / f"plots/{over}.svg").read_text()
            for text in (over, unit, "F-score", "gaussian", "30 points", "own count", "random vertices"):
                self.assertIn(text, drawing)

    def test_no_plot_without_a_perturbation(self):
        self.morsel("stability", SMALL, "--method", "conventional", "--decimate", "0.8", "--trials", "1",
                    "--figures", "plots")
        self.assertEqual([path.name for path in made_in(self.folder / "plots")],
                         ["vertices.png", "vertices.svg"])

    def test_standard_output(self):
        result = self.morsel("stability", self.file("o.off", OCTAHEDRON), "--field", "height", "--trials",
                             "1",
                             "-o", "-")
        self.assertEqual(json.loads(result.stdout)["schema"], "morsel.stability/1")


class Interruption(Stability):
    ARGUMENTS = (SMALL, "--method", "salient:iterations=200", "--noise", "0.1,0.3", "--trials", "12",
                 "--threads", "2")

    def test_a_run_that_is_ended_in_any_way_goes_on_where_it_was(self):
        whole = self.stability(*self.ARGUMENTS)
        del whole["timings"]
        for how, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGKILL, -signal.SIGKILL)):
            journal = self.folder / "s.json.journal"
            interrupted(self.folder, ("stability", *self.ARGUMENTS, "-o", "s.json"), how, code,
                        lambda: journal.exists() and journal.read_bytes().count(b"\n") >= 5)
            self.assertFalse((self.folder / "s.json").exists())
            result = self.morsel("stability", *self.ARGUMENTS, "-o", "s.json")
            self.assertRegex(result.stderr, r"resuming with [0-9]+ perturbed surfaces done: s.json.journal")
            document = json.loads((self.folder / "s.json").read_text())
            del document["timings"]
            self.assertEqual(document, whole)
            self.assertFalse(journal.exists())
            (self.folder / "s.json").unlink()


class Refused(Stability):
    def refuse(self, *arguments, naming, code=2):
        result = self.morsel("stability", LION, *arguments, code=code)
        for word in naming:
            self.assertIn(word, result.stderr)

    def test_options(self):
        self.refuse("--noise=-0.1", naming=["-0.1", "edge lengths"])
        self.refuse("--noise", "0.1,x", naming=["x"])
        self.refuse("--noise", "inf", naming=["inf"])
        self.refuse("--decimate", "0", naming=["decimation", "0"])
        self.refuse("--decimate", "50", naming=["50", "at most 1"])
        self.refuse("--subdivide", "1.5", naming=["1.5", "whole"])
        self.refuse("--trials", "0", naming=["trials"])
        self.refuse("--target", "0", naming=["target"])
        self.refuse("--radius", "far", naming=["radius", "far"])
        self.refuse("--radius=-2%", naming=["-2%"])
        self.refuse("--kind", "odd", naming=["odd", "isotropic"])
        self.refuse("--points", "odd", naming=["odd", "extrema"])
        self.refuse("--method", "nonsense", naming=["nonsense", "salient"])
        self.refuse("--field", "nonsense", naming=["nonsense", "height"])
        self.refuse("--reference", "nonsense", naming=["nonsense"])
        self.refuse("--preset", "best", naming=["paper", "resampled", "best"])
        self.refuse("--preset", "noise", "--field", "height", naming=["--preset", "--field"])
        self.refuse("--preset", "noise", "--method", "tps", naming=["--preset", "--method"])
        self.refuse("--field", "vertex-scalar:file=v.txt", "--subdivide", "2",
                    naming=["vertex-scalar", "subdivision"])

    def test_files(self):
        self.refuse("-o", "s.txt", naming=["s.txt", ".json", ".csv"])
        self.file("taken", "")
        self.refuse("-o", "taken/s.json", naming=["taken"], code=4)
        self.morsel("stability", "absent.off", "-o", "s.json", code=3)
        self.assertEqual(os.listdir(self.folder), ["taken"])  # no half-written document

    def test_a_trial_that_fails(self):
        mesh = self.file("o.off", OCTAHEDRON)
        result = self.morsel("stability", mesh, "--field", "height", "--decimate", "0.1", "-o", "s.json",
                             code=3)
        self.assertIn("decimation 0.1, trial 1: ", result.stderr)
        self.assertEqual(os.listdir(self.folder), ["o.off"])


if __name__ == "__main__":
    unittest.main()
