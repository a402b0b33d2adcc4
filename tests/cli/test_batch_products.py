"""morsel batch: pages, pictures and files of each mesh."""

import re
import shutil
import struct
import unittest
import urllib.parse

from png import Png
from test_batch import BatchTest, contents

ALL = ("--html", "--figures", "--export", "--size", "200x150")


def size_of(picture):
    return struct.unpack(">II", picture.read_bytes()[16:24])


class Products(BatchTest):
    def files(self, kind, out="out"):
        folder = self.folder / out / kind
        return sorted(str(path.relative_to(folder)) for path in folder.rglob("*")
                      if path.is_file() and path.name != ".morsel-results")

    def test_each_mesh_has_what_compare_makes(self):
        self.batch(*ALL, "--no-items", pictures=True)
        self.assertEqual(self.files("pages"), [f"{name}.html" for name in self.names])
        # With the arguments of batch, since files name the command that made them.
        self.morsel("compare", "--field", "mean-curvature", "--method", "conventional",
                    "--method", "salient:iterations=2", "--no-items", "--view", "best", "--up", "y",
                    "--size", "200x150", "--figures", "figures",
                    "--export", "exports",
                    "--", "meshes/sphere.off")
        for kind in ("figures", "exports"):
            alone = contents(self.folder / kind)
            self.assertEqual(contents(self.out / kind / "sphere.off"), alone)
            self.assertEqual(self.files(kind), [f"{name}/{file}" for name in self.names for file in alone])
        for mesh in self.summary()["meshes"]:
            self.assertEqual([mesh[key] for key in ("page", "figures", "exports")],
                             [f"pages/{mesh['name']}.html", f"figures/{mesh['name']}",
                              f"exports/{mesh['name']}"])
        self.assertFalse((self.out / "work").exists())

    def test_a_page_tells_how_to_make_it_where_it_is(self):
        self.batch("--html", "--snap")
        page = (self.out / "pages/sphere.off.html").read_text()
        self.assertIn("morsel compare meshes/sphere.off --field mean-curvature --method conventional "
                      "--method salient:iterations=2 --snap --html out/pages/sphere.off.html", page)
        self.assertNotIn("out/work", page)

    def test_every_link_of_the_page_leads_somewhere(self):
        self.file("meshes/bad.off", "OFF\n")
        self.morsel_batch("meshes", "--out", "out", *ALL, "--method", "conventional", code=1)
        page = (self.out / "index.html").read_text()
        links = [urllib.parse.unquote(link) for link in re.findall(r'(?:href|src)="([^"]*)"', page)]
        for link in links:
            self.assertTrue(link == "data:," or (self.out / link).exists(), link)
        for name in self.names:
            for link in (f"pages/{name}.html", f"reports/{name}.json", f"figures/{name}/sheet.png",
                         f"exports/{name}/"):
                self.assertIn(link, links)
        self.assertFalse([link for link in links if "bad.off" in link])

    def test_what_is_missing_is_made_again(self):
        self.batch(*ALL)
        self.assertIn("(3 by earlier runs)", self.batch(*ALL).stdout)
        for gone in ("pages/sphere.off.html", "figures/sphere.off/sheet.png", "exports/sphere.off"):
            before = self.times()
            path = self.out / gone
            shutil.rmtree(path) if path.is_dir() else path.unlink()
            self.batch(*ALL)
            self.assertEqual(self.rerun(before), ["sphere.off"], gone)
            self.assertTrue(path.exists())

    def test_what_is_not_wanted_any_more_goes(self):
        self.batch(*ALL, pictures=True)
        self.batch("--export")
        self.assertEqual(self.files("pages") + self.files("figures") + self.files("thumbnails"), [])
        self.assertEqual(len({name.split("/")[-2] for name in self.files("exports")}), 3)
        self.octahedron.write_text("OFF\n")
        self.batch("--export", code=1)
        self.assertFalse((self.out / "exports/octahedron.off").exists())

    def test_the_camera_is_that_of_all_pictures(self):
        pictures = ("--method", "conventional", "--only", "deeper/an anchor.off")
        for out, arguments in (("best", ()), ("left", ("--view", "left")),
                               ("low", ("--view=-30/-20", "--up", "z")),
                               ("figures", ("--view", "left", "--figures", "--size", "120x90", "--inset",
                                            "3:10eps"))):
            self.morsel_batch("meshes", "--out", out, *pictures, *arguments)
        place = "thumbnails/deeper/an anchor.off.first.png"
        first = {out: tuple(map(bytes, Png((self.folder / out / place).read_bytes()).rows))
                 for out in ("best", "left", "low", "figures")}
        self.assertEqual(first["left"], first["figures"])
        self.assertEqual(len(set(first.values())), 3)
        # a caption is below the picture
        self.assertEqual(size_of(self.folder / "figures/figures/deeper/an anchor.off/conventional.png")[0],
                         120)
        request = self.summary("figures")["request"]
        self.assertEqual([request[key] for key in ("view", "up", "size", "inset")],
                         ["left", "y", "120x90", "3:10eps"])
        request = self.summary("low")["request"]
        self.assertEqual([request[key] for key in ("view", "up", "size", "inset")],
                         ["-30/-20", "z", None, None])


    def test_a_vertex_that_a_mesh_does_not_have_is_that_mesh_s_failure(self):
        self.batch("--figures", "--size", "120x90", "--inset", "7", code=1)
        self.assertEqual(self.statuses(), {**dict.fromkeys(self.names, "done"), "octahedron.off": "failed"})

    def test_wrong_values_are_refused_before_the_work(self):
        for wrong, said in ((("--size", "120x90"), "--figures"), (("--inset", "3"), "--figures"),
                            (("--figures", "--size", "big"), "big"), (("--view", "above"), "above"),
                            (("--up", "w"), "w"), (("--figures", "--inset", "x"), "x")):
            with self.subTest(wrong=wrong):
                self.assertIn(said, self.morsel_batch("meshes", "--out", "out", *wrong, code=2).stderr)
                self.assertEqual(contents(self.out), {})

    def test_one_name_is_not_another_s_folder(self):
        self.file("meshes/list", "sphere.off\n/sphere.off/x.off\n")
        self.assertIn("sphere.off/x.off", self.morsel_batch("meshes/list", "--out", "out", code=3).stderr)


if __name__ == "__main__":
    unittest.main()
