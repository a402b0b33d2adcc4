"""morsel reproduce: figures, table, numbers and page; and small pictures compared with those in
tests/cli/pictures.

Pictures may differ a little between processors, so they are compared with a tolerance. Where they are meant
to change, look at the new ones and put them there with

    MORSEL_RENEW_PICTURES=1 tools/test -R "cli: reproduce"
"""

import csv
import html.parser
import json
import os
import pathlib
import re
import shlex
import shutil
import tempfile
import unittest
from base64 import b64decode

import jsonschema
from png import Png, without_texts
from support import OCTAHEDRON, SAMPLES, SCHEMA, ProgramTest, made_in

REPRODUCTION_SCHEMA = SCHEMA.parent / "reproduction.schema.json"
PICTURES = pathlib.Path(__file__).parent / "pictures"
KEPT = ("figure1b.png", "figure2b.png", "figure3d.png", "figure4c.png")
SMALL = ("--size", "160x120", "--samples", "9")
PANELS = ["figure1a", "figure1b", "figure1c", "figure1d", "figure2a", "figure2b", "figure3a", "figure3b",
          "figure3c", "figure3d", "figure3e", "figure4a", "figure4b", "figure4c", "section3.1a",
          "section3.1b", "section3.1c", "section3.1d"]


def difference(a, b):
    """Of two pictures: the mean absolute difference of a channel, and the share of the pixels that are far
    off, in any channel by more than 48 of 255; None if their sizes differ."""
    if (a.width, a.height, a.channels) != (b.width, b.height, b.channels):
        return None
    total = far = 0
    for p, q in zip(a.pixels(), b.pixels()):
        apart = [abs(x - y) for x, y in zip(p, q)]
        total += sum(apart)
        far += max(apart) > 48
    pixels = a.width * a.height
    return total / (pixels * a.channels), far / pixels


def is_alike(a, b):
    """Whether they look like the same picture."""
    apart = difference(a, b)
    return apart is not None and apart[0] < 0.5 and apart[1] < 0.005


class Page(html.parser.HTMLParser):
    """What a page refers to, its text, and the commands to copy."""

    def __init__(self, text):
        super().__init__()
        self.references, self.images, self.commands, self.open, self.text = [], [], [], [], ""
        self.alone = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        if tag == "img":
            self.images.append(attributes)
        self.references += [attributes[key] for key in ("src", "href") if key in attributes]
        if tag in ("meta", "link", "img", "wbr"):
            return
        self.open.append(tag)
        if tag == "pre":
            self.commands.append("")

    def handle_endtag(self, tag):
        if self.open.pop() != tag:
            self.alone.append(tag)

    def handle_data(self, data):
        self.text += data
        if self.open and self.open[-1] == "pre":
            self.commands[-1] += data


class Reproduction(ProgramTest):
    """One run on small meshes, with all its outputs."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.whole = pathlib.Path(folder.name)
        cls.data = cls.whole / "data"
        cls.data.mkdir()
        shutil.copy(SAMPLES / "lion-head.off", cls.data / "My_LION.off")
        shutil.copy(SAMPLES / "homer.off", cls.data / "squirrel.off")
        made = cls("run_once")
        made.folder = cls.whole
        cls.printed = made.morsel("reproduce", "out", "--data", "data", "--meshes", SAMPLES, *SMALL).stdout
        cls.out = cls.whole / "out"
        cls.document = json.loads((cls.out / "reproduction.json").read_text())

    def run_once(self):
        """Only to make an instance before any test runs."""

    def picture(self, name):
        return Png((self.out / name).read_bytes())

    def test_everything_is_there(self):
        names = {f"{panel}.png" for panel in PANELS} | {f"figure{n}.png" for n in (1, 2, 3, 4)}
        self.assertEqual({path.name for path in made_in(self.out)},
                         names | {"section3.1.png", "torus.off", "table1.csv", "controls.csv",
                                  "reproduction.json", "index.html"})
        for panel in PANELS:
            picture = self.picture(panel + ".png")
            self.assertEqual((picture.width, picture.height), (160, 120))
        for number, columns in ((1, 2), (2, 2), (3, 3), (4, 3)):
            self.assertGreaterEqual(self.picture(f"figure{number}.png").width, columns * 160)

    def test_the_numbers_follow_their_schema(self):
        schema = json.loads(REPRODUCTION_SCHEMA.read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        jsonschema.validate(self.document, schema)
        models = {model["name"]: model for model in self.document["models"]}
        self.assertEqual([models[m]["sample"] for m in ("lion", "squirrel", "protein")], [False, False, True])
        self.assertTrue(models["lion"]["mesh"]["path"].endswith("My_LION.off"))
        self.assertTrue(models["protein"]["mesh"]["path"].endswith("retinal.off"))
        self.assertEqual([model["made"] for model in models.values()], [False, False, False, True])
        self.assertEqual(models["torus"]["mesh"]["path"], "torus.off")

    def test_counts_are_those_of_compare(self):
        rows = {(row["model"], row["iterations"]): row for row in self.document["table"]}
        self.assertEqual(len(rows), 7)
        for model, iterations, mesh in (("lion", 10, self.data / "My_LION.off"),
                                        ("protein", 1, SAMPLES / "retinal.off")):
            methods = [run["specification"] for run in rows[model, iterations]["runs"]]
            self.assertEqual(len(methods), 4)
            report = self.report(mesh, *(word for method in methods for word in ("--method", method)))
            for run, method in zip(rows[model, iterations]["runs"], report["methods"]):
                self.assertEqual(run["critical_points"], method["critical_points"])
                self.assertEqual(run["method"]["parameters"], method["parameters"])
        self.assertEqual(rows["lion", 10]["paper"], {"points": 493, "seconds": 3.9})
        self.assertEqual(rows["protein", 0]["paper"], {"points": None, "seconds": None})
        # Reference counts for this mesh: conventional, and local with support 1 after 10.
        self.assertEqual(rows["lion", 0]["runs"][0]["critical_points"]["total"], 1895)
        self.assertEqual(rows["lion", 10]["runs"][0]["critical_points"]["total"], 136)

    def test_the_table_is_the_same_everywhere(self):
        with (self.out / "table1.csv").open(newline="") as file:
            rows = list(csv.DictReader(file))
        wanted = [(row["model"], run["specification"], run["critical_points"]["total"])
                  for row in self.document["table"] for run in row["runs"]]
        self.assertEqual([(row["model"], row["method"], int(row["points"])) for row in rows], wanted)
        self.assertEqual(len(rows), 3 + 4 * 4)
        for row in rows:
            self.assertGreaterEqual(float(row["seconds"]), 0)
        page = (self.out / "index.html").read_text()
        for _, _, total in wanted:
            self.assertIn(f"<td>{total:,}<small>", page)
            self.assertIn(f"{total:,}", self.printed)

    def test_percentiles_are_those_of_the_extrema(self):
        """As morsel points has them, which takes all extrema here."""
        lion = self.data / "My_LION.off"
        rows = {(row["model"], row["iterations"]): row["runs"][0] for row in self.document["table"]}
        for iterations, method in ((0, "conventional"), (10, "salient:iterations=10,range=local,support=1")):
            run = rows["lion", iterations]
            self.assertEqual(run["specification"], method)
            counts = run["critical_points"]
            self.morsel("points", lion, "--field", "mean-curvature", "--method", method, "--points",
                        counts["minima"] + counts["maxima"], "--spacing", 0, "--fill", "none",
                        "--percentiles", "-o", "p.json")
            points = json.loads((self.folder / "p.json").read_text())
            self.assertEqual(points["count"], counts["minima"] + counts["maxima"])
            self.assertAlmostEqual(run["percentile"], points["mean_percentile"], places=9)

    def test_controls_are_held_to_the_count_of_the_papers_method(self):
        with (self.out / "controls.csv").open(newline="") as file:
            table = list(csv.DictReader(file))
        controls = self.document["controls"]
        self.assertEqual(len(controls), 4 * 5)
        page = Page((self.out / "index.html").read_text()).text
        for i, (control, line) in enumerate(zip(controls, table)):
            first = controls[i - i % 5]
            counts = control["critical_points"]
            self.assertEqual(control["iterations"], first["iterations"])
            if i % 5 == 0:
                self.assertIn("range=local", control["specification"])
            elif i % 5 == 1:
                self.assertEqual(control["specification"], first["specification"].replace("local", "none"))
            elif i % 5 == 2:
                total = first["critical_points"]["total"]
                self.assertEqual(control["specification"], f"tps:count={total}")
                self.assertIn(total - counts["total"], (0, 1))
            elif i % 5 == 3:
                self.assertEqual((control["rank"], control["extrema"]), ("salience", first["extrema"]))
                self.assertGreater(control["percentile"], controls[i + 1]["percentile"])
            if control["rank"] is None:
                self.assertEqual(control["extrema"], counts["minima"] + counts["maxima"])
            of_table = (line["control"], line["method"], int(line["points"]), float(line["percentile"]))
            self.assertEqual(of_table, (control["control"], control["specification"], counts["total"],
                                        control["percentile"]))
            self.assertIn(control["control"], self.printed)
            self.assertIn(control["control"], page)

    def test_tps_and_ours_are_compared_where_the_field_has_most_points(self):
        figure = self.document["figures"][2]
        totals = [panel["critical_points"]["total"] for panel in figure["panels"]]
        self.assertLess(totals[2], totals[0])
        self.assertIn(totals[2] - totals[1],
                      (0, 1))  # a pair less where the parity of simple saddles asks for it
        self.assertEqual(totals[1], totals[3])
        self.assertEqual(totals[2], totals[4])
        region = figure["region"]
        self.assertGreaterEqual(region["all"], region["first"])
        self.assertGreaterEqual(region["places"], region["more_of_first"] + region["more_of_second"])
        for letter, panel in zip("bcde", figure["panels"][1:]):
            option = "--frame" if letter in "bc" else "--close-up"
            self.assertIn(f"{option} {region['vertex']}:{region['radius']} ", panel["command"])
        self.assertIn(f"around vertex {region['vertex']:,},", figure["here"])

    def test_the_absolute_difference_swaps_types_on_the_torus(self):
        figure = self.document["figures"][4]
        self.assertEqual((figure["figure"], figure["section"]), (None, "3.1"))
        totals = [panel["critical_points"]["total"] for panel in figure["panels"]]
        self.assertEqual((totals[0], totals[3]), (4, 4))
        self.assertGreater(totals[1], 4)
        for panel, lowest in (("(a)", "minimum"), ("(b)", "maximum"), ("(d)", "minimum")):
            self.assertIn(f"In {panel} the highest vertex of the torus is a maximum and the lowest a "
                          f"{lowest}, of", figure["here"])

    def test_levels_add_up(self):
        figure = self.document["figures"][3]
        self.assertEqual([level["points"] for level in figure["levels"]],
                         [panel["critical_points"]["total"] for panel in figure["panels"]])
        for level in figure["levels"][1:]:
            self.assertEqual(level["kept"] + level["moved"] + level["new"], level["points"])

    def test_each_command_makes_its_panel(self):
        panels = {panel["file"]: panel["command"] for figure in self.document["figures"]
                  for panel in figure["panels"]}
        self.assertEqual(sorted(panels), sorted(f"{panel}.png" for panel in PANELS))
        shutil.copytree(self.data, self.folder / "data")
        shutil.copy(self.out / "torus.off", self.folder)
        for file in ("figure1b.png", "figure1c.png", "figure2a.png", "figure3b.png", "figure3d.png",
                     "figure4a.png", "section3.1b.png"):
            words = shlex.split(panels[file])
            self.assertEqual(words[0], "morsel")
            self.morsel(*words[1:])
            self.assertEqual((self.folder / file).read_bytes(), (self.out / file).read_bytes(), panels[file])

    def test_the_page_holds_everything_and_loads_nothing(self):
        text = (self.out / "index.html").read_text()
        page = Page(text)
        self.assertEqual((page.open, page.alone), ([], []))
        for reference in page.references:
            self.assertTrue(reference.startswith("data:"), reference[:80])
        self.assertNotIn("<script", text)
        self.assertIsNone(re.search(r"url\(|@import|https?:", text))
        self.assertEqual([b64decode(image["src"].split(",")[1]) for image in page.images],
                         [(self.out / f"{panel}.png").read_bytes() for panel in PANELS])
        self.assertTrue(all(len(image["alt"]) > 10 for image in page.images))
        commands = [panel["command"] for figure in self.document["figures"] for panel in figure["panels"]]
        self.assertEqual(page.commands[:-1], commands)
        self.assertTrue(page.commands[-1].startswith("morsel reproduce out --data data"))
        for figure in self.document["figures"]:
            self.assertIn(figure["paper"], page.text)
            self.assertIn(figure["here"], page.text)
        for word in ("My_LION.off", "squirrel.off", "retinal.off", "prefers-color-scheme: dark",
                     "width=device-width"):
            self.assertIn(word, text)

    def test_pictures_look_as_they_did(self):
        for name in KEPT:
            if os.environ.get("MORSEL_RENEW_PICTURES"):
                (PICTURES / name).write_bytes(without_texts((self.out / name).read_bytes()))
            data = (PICTURES / name).read_bytes()
            self.assertEqual(data, without_texts(data))
            kept = Png(data)
            self.assertTrue(is_alike(self.picture(name), kept),
                            f"{name}: {difference(self.picture(name), kept)}")

    def test_pictures_that_look_different_are_detected(self):
        commands = {panel["file"]: shlex.split(panel["command"])[1:]
                    for figure in self.document["figures"] for panel in figure["panels"]}
        shutil.copytree(self.data, self.folder / "data")
        changes = {"figure1b.png": [["--no-points"], ["--method", "salient"], ["--colormap", "purple-green"],
                                    ["--view", "front"]],
                   "figure2b.png": [["--method", "salient:iterations=9,range=local,support=1"], ["--no-arcs"],
                                    ["--show", "descending"]],
                   "figure3d.png": [["--method", "conventional"], ["--show", "descending"], ["--no-arcs"]],
                   "figure4c.png": [["--method", "salient:iterations=9,range=local,support=1"],
                                    ["--no-points"]]}
        for file, options in changes.items():
            kept = Png((PICTURES / file).read_bytes())
            for change in options:
                words = commands[file].copy()
                if change[0] in words:  # given once only
                    at = words.index(change[0])
                    del words[at:at + len(change)]
                self.morsel(*words, *change)
                changed = Png((self.folder / file).read_bytes())
                self.assertFalse(is_alike(changed, kept),
                                 f"{file} with {change}: {difference(changed, kept)}")
        # Differences between processors are accepted: single colour levels, an edge that is rounded
        # otherwise.
        nearly = Png((PICTURES / "figure1b.png").read_bytes())
        for y, row in enumerate(nearly.rows):
            for x in range(0, len(row), 7):
                row[x] = min(255, row[x] + (x + y) % 2)
        nearly.rows[60][150:156] = bytes(6)
        self.assertTrue(is_alike(nearly, Png((PICTURES / "figure1b.png").read_bytes())))


class Requests(ProgramTest):
    def test_the_same_at_any_number_of_threads(self):
        data = self.folder / "data"
        data.mkdir()
        for name in ("lion", "squirrel", "protein"):
            shutil.copy(SAMPLES / "elk.off", data / f"{name}.off")
        seen = []
        for threads in (1, 3):
            self.morsel("reproduce", f"out{threads}", "--data", data, *SMALL, "--threads", threads, "--view",
                        "20/10",
                        "--view=lion=-30/5", "--up", "lion=z")
            out = self.folder / f"out{threads}"
            document = json.loads((out / "reproduction.json").read_text())
            del document["timings"]
            seen.append(([(path.name, path.read_bytes()) for path in sorted(out.glob("*.png"))], document))
        self.assertEqual(seen[0], seen[1])
        views = [model["view"] for model in seen[0][1]["models"]]
        self.assertEqual(views, ["-30/5", "20/10", "20/10", "20/10"])
        self.assertIn("--view=-30/5 --up z", seen[0][1]["figures"][0]["panels"][0]["command"])

    def test_wrong_requests_are_refused_before_any_work(self):
        for options in (["--size", "10"], ["--size", "0x5"], ["--samples", "0"], ["--view", "below"],
                        ["--view", "tiger=front"], ["--view", "lion=x"], ["--up", "w"], ["--up", "lion=up"],
                        ["--figure"]):
            self.morsel("reproduce", "out", *options, code=2)
        self.morsel("reproduce", code=2)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_what_is_missing_is_reported_in_one_sentence(self):
        result = self.morsel("reproduce", "out", "--meshes", "nowhere", code=3)
        for word in ("lion-head.off", "bunny00.off", "retinal.off", "nowhere", "--meshes"):
            self.assertIn(word, result.stderr)
        data = self.folder / "data"
        data.mkdir()
        self.assertIn("1bp2", self.morsel("reproduce", "out", "--data", data, code=3).stderr)
        self.assertIn("no folder gone", self.morsel("reproduce", "out", "--data", "gone", code=3).stderr)
        (data / "sea_lion.off").write_text(OCTAHEDRON)
        result = self.morsel("reproduce", "out", "--data", data, "--meshes", "nowhere", code=3)
        self.assertNotIn("lion-head", result.stderr)
        self.assertIn("bunny00.off", result.stderr)
        (data / "lion-head.OFF").write_text(OCTAHEDRON)
        result = self.morsel("reproduce", "out", "--data", data, code=3)
        self.assertIn("lion-head.OFF and sea_lion.off", result.stderr)
        (data / "lion.ply").write_text("ply\n")
        self.assertIn("lion.ply", self.morsel("reproduce", "out", "--data", data, "--meshes", SAMPLES,
                                              code=3).stderr)

    def test_what_cannot_be_written_is_refused_before_the_work(self):
        (self.folder / "file").write_text("")
        self.morsel("reproduce", "file", "--meshes", SAMPLES, code=4)
        self.assertEqual((self.folder / "file").read_text(), "")


if __name__ == "__main__":
    unittest.main()
