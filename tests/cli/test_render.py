"""morsel render and morsel compare --figures: pictures read back by other code."""

import unittest

from png import Png
from support import DAMAGED, OCTAHEDRON, SAMPLES, ProgramTest, made_in

BUNNY = SAMPLES / "bunny00.off"
LION = SAMPLES / "lion-head.off"
SMALL = ("--size", "240x180", "--samples", "4")


class Render(ProgramTest):
    def picture(self, *arguments, name="picture.png"):
        self.morsel("render", *arguments, "-o", name)
        return Png((self.folder / name).read_bytes())

    def test_a_picture_shows_the_surface_its_points_and_the_colour_bar(self):
        picture = self.picture(BUNNY, "--method", "salient", *SMALL)
        self.assertEqual((picture.width, picture.height, picture.channels), (240, 180, 3))
        pixels = list(picture.pixels())
        white = sum(p == (255, 255, 255) for p in pixels) / len(pixels)
        self.assertTrue(0.2 < white < 0.8, white)
        reds = sum(r > 120 and g < 60 and b < 60 for r, g, b in pixels)
        greens = sum(g > 90 and r < 70 and b < 90 for r, g, b in pixels)
        blues = sum(b > 110 and r < 60 and g < 100 for r, g, b in pixels)
        for count in (reds, greens, blues):
            self.assertGreater(count, 3, (reds, greens, blues))

    def test_known_pixels_have_the_colour_of_their_value(self):
        # A square from x = -1 to 1, seen from the front, its colours those of x from -1 to 1.
        mesh = self.file("square.off", "OFF\n4 2 0\n-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n3 0 1 2\n3 0 2 3\n")
        picture = self.picture(mesh, "--field", "height:axis=x", "--range=-1/1", "--view", "front",
                               "--no-points",
                               "--size", "120x120", "--no-legend")
        left, middle, right = (picture.pixel(x, 60) for x in (8, 60, 111))
        self.assertGreater(left[2], left[0] + 60)    # blue
        self.assertGreater(right[0], right[2] + 60)  # orange
        self.assertLess(max(middle) - min(middle), 12)
        self.assertGreater(min(middle), 170)
        self.assertEqual(picture.pixel(1, 1), (255, 255, 255))

    def test_the_background_can_be_transparent(self):
        picture = self.picture(self.file("o.off", OCTAHEDRON), "--field", "height", "--view", "30/20",
                               "--background",
                               "transparent", *SMALL)
        self.assertEqual(picture.channels, 4)
        self.assertEqual(picture.pixel(0, 0)[3], 0)
        self.assertEqual(picture.pixel(85, 90)[3], 255)

    def test_the_same_bytes_with_any_number_of_threads(self):
        wanted = None
        for threads in (1, 2, 7):
            self.morsel("render", LION, "--method", "salient", "--show", "morse-smale", "--inset", "100",
                        "--caption", "auto",
                        *SMALL, "--threads", threads, "-o", "t.png")
            data = (self.folder / "t.png").read_bytes()
            wanted = wanted or data
            self.assertEqual(data, wanted)

    def test_what_is_shown_makes_a_difference(self):
        seen = set()
        for options in ([], ["--no-points"], ["--arcs"], ["--show", "plain"], ["--show", "descending"],
                        ["--show", "descending", "--no-arcs"], ["--show", "ascending"],
                        ["--show", "morse-smale"],
                        ["--colormap", "purple-green"], ["--center", "none"], ["--range", "20%"],
                        ["--up", "z"],
                        ["--view", "back"], ["--inset", "7:10eps"], ["--caption", "a caption"],
                        ["--no-legend"]):
            view = [] if "--view" in options else ["--view", "front"]
            picture = self.picture(LION, "--method", "salient", *SMALL, *view, *options)
            seen.add((picture.width, picture.height, b"".join(picture.rows)))
        self.assertEqual(len(seen), 16)

    def test_vertices_are_those_of_the_input(self):
        mesh = self.file("d.off", DAMAGED)
        self.picture(mesh, "--repair", "--field", "height:axis=x", *SMALL, "--view", "front", "--inset",
                     "4:0.2")
        for vertex in (1, 5, -1):  # dropped; not there
            result = self.morsel("render", mesh, "--repair", "--field", "height:axis=x", f"--inset={vertex}",
                                 "-o", "i.png",
                                 code=2)
            self.assertIn(f"vertex {vertex} ", result.stderr)

    def test_wrong_requests_are_refused_before_any_work(self):
        for options in (["--size", "0x900"], ["--size", "100000x900"], ["--size", "big"], ["--view", "below"],
                        ["--view", "10/100"], ["--samples", "0"], ["--background", "pink"],
                        ["--colormap", "jet"],
                        ["--range", "5/1"], ["--center", "mean"], ["--show", "all"], ["--up", "w"],
                        ["--inset", "x"],
                        ["--method", "none"], ["--target", "0"]):
            # The mesh does not exist, but that is not the error.
            result = self.morsel("render", "missing.off", *options, "-o", "w.png", code=2)
            self.assertNotIn("missing.off", result.stderr)
        self.assertEqual(list(self.folder.glob("*.png")), [])
        self.morsel("render", "missing.off", "-o", "w.png", code=3)
        self.morsel("render", self.file("o.off", OCTAHEDRON), "-o", "o.off/w.png", code=4)
        self.morsel("render", self.folder / "o.off", "--caption",
                    b"\xff\xfe".decode("utf-8", "surrogateescape"), "-o",
                    "w.png", code=2)
        self.assertEqual(list(self.folder.iterdir()), [self.folder / "o.off"])

    def test_compare_makes_a_picture_of_each_method_and_a_sheet(self):
        mesh = self.file("o.off", OCTAHEDRON)
        self.morsel("compare", mesh, "--field", "height", "--method", "conventional", "--method",
                    "conventional",
                    "--figures", "figures", "--view", "30/20")
        figures = self.folder / "figures"
        self.assertEqual(sorted(p.name for p in made_in(figures) if "diagram" not in p.name
                                and "pers" not in p.name),
                         ["conventional-2.png", "conventional.png", "sheet.png"])
        self.assertEqual((figures / "conventional.png").read_bytes(),
                         (figures / "conventional-2.png").read_bytes())
        sheet = Png((figures / "sheet.png").read_bytes())
        self.assertGreater(sheet.width, 2 * 1200)
        for x, y in ((480, 400), (420, 460), (1, 1)):  # the same picture twice
            self.assertEqual(sheet.pixel(x, y), sheet.pixel(x + sheet.width - 1200, y))
        self.assertNotEqual(sheet.pixel(480, 400), (255, 255, 255))
        for wrong in (["--view", "below"], ["--inset", "x"]):
            self.morsel("compare", mesh, "--figures", "more", *wrong, code=2)
        self.morsel("compare", mesh, "--figures", "o.off", code=2)


if __name__ == "__main__":
    unittest.main()
