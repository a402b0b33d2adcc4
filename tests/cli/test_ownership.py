"""Files of the user are safe: no command removes, replaces or follows what it did not make, wherever it
is."""

import hashlib
import json
import os
import shutil
import stat
import subprocess
import unittest

from support import OCTAHEDRON, ON_MESH, PROGRAM, SAMPLES, ProgramTest, until

LIST = ".morsel-results"
QUICK = ("--method", "conventional")
SMALL = ("--size", "60x42")
NOBODY = 65534
# What batch writes into OUT; folders end with a slash.
PLACES = ("work/", "figures/", "exports/", "reports/", "state/", "thumbnails/", "pages/", "plots/",
          "index.html",
          "summary.csv", "summary.json")


def contents(folder):
    """Everything in a folder: its kind, and the hash of a file or the target of a link."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if path.is_symlink():
            found[name] = os.readlink(path)
        elif path.is_file():
            found[name] = hashlib.sha256(path.read_bytes()).hexdigest()
        else:
            found[name] = "folder"
    return found


def name_in(line):
    """The name in a line of a list."""
    return line[1:].split(" ")[0]


class OwnershipTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.file("m.off", OCTAHEDRON)
        self.values = self.file("values.txt", "".join(f"{i}\n" for i in range(6)))

    def meshes(self, name="meshes"):
        """A collection with a file that is no mesh."""
        folder = self.folder / name
        folder.mkdir(parents=True)
        for mesh in ("a.off", "b.off"):
            (folder / mesh).write_text(OCTAHEDRON)
        (folder / "notes.txt").write_text("the only copy")
        return folder

    def refused(self, *arguments, naming=(), code=2, **options):
        """The command ends with `code` and one sentence, and nothing in the test's folder is other than
        before."""
        before = contents(self.folder)
        result = self.morsel(*arguments, code=code, **options)
        self.assertEqual(contents(self.folder), before, arguments)
        for word in naming:
            self.assertIn(word, result.stderr)
        return result.stderr

    def kept(self, before):
        """All of `before` is unchanged; other files do not matter."""
        now = contents(self.folder)
        self.assertEqual({name: now.get(name) for name in before}, before)

    def mounted(self, *options):
        """A folder of its own file system."""
        point = self.folder / "mounted"
        point.mkdir()
        result = subprocess.run(["mount", "-t", "tmpfs", "-o", ",".join(("size=16m", *options)), "tmpfs",
                                 point],
                                capture_output=True, text=True, check=False)
        if result.returncode != 0:
            self.skipTest(f"no tmpfs can be mounted: {result.stderr.strip()}")
        self.addCleanup(subprocess.run, ["umount", "-l", point], check=True)
        return point


class Batch(OwnershipTest):
    def batch(self, collection, out, *arguments, **options):
        return self.morsel("batch", collection, "--out", out, *QUICK,
                           *(SMALL if "--figures" in arguments else ()),
                           *arguments, **options)

    def test_a_collection_named_work_is_not_emptied(self):
        """`morsel batch work --out .` once removed the whole collection."""
        self.meshes("work")
        (self.folder / "work/deeper").mkdir()
        self.refused("batch", "work", "--out", ".", naming=["work"])

    def test_a_collection_named_as_a_place_of_out_is_not_put_aside(self):
        """`morsel batch figures --out .` once removed all meshes, even without --figures."""
        for place in PLACES:
            folder = self.folder / place.replace("/", "")
            with self.subTest(place=place):
                self.meshes(folder.name)
                for products in ((), ("--figures", "--export", "--html")):
                    self.refused("batch", folder.name, "--out", ".", *QUICK, *products, naming=["choose"])
                shutil.rmtree(folder)

    def test_collection_and_out_are_not_one_or_in_one_another(self):
        self.meshes("a/meshes")
        (self.folder / "link").symlink_to("a")
        (self.folder / "to-meshes").symlink_to("a/meshes")
        for out in ("a/meshes", "a/meshes/", "a", ".", "a/meshes/out", "a/meshes/deeper/out", "link",
                    "link/meshes/out",
                    "to-meshes", "to-meshes/out", "a/../a/meshes/out", self.folder / "a/meshes"):
            for collection in ("a/meshes", "link/meshes", "to-meshes"):
                with self.subTest(out=out, collection=collection):
                    self.refused("batch", collection, "--out", out, *QUICK,
                                 naming=["--out", "COLLECTION", "choose"])
        self.batch("a/meshes", "a/out")  # beside it
        self.refused("batch", "a", "--out", "a/out", *QUICK, naming=["--out"])  # though it is marked

    def test_a_list_is_not_in_out(self):
        self.meshes()
        self.batch("meshes", "out")
        shutil.copy(self.folder / "out/summary.csv", self.folder / "out/list")
        self.refused("batch", "out/list", "--out", "out", naming=["COLLECTION"])

    def test_an_out_that_is_not_morsels_is_refused(self):
        self.meshes()
        for name in ("thesis.txt", ".hidden", "folder/file", "index.html", "state/notes.json",
                     "meshes-of-mine/a.off"):
            with self.subTest(name=name):
                out = self.folder / "out"
                (out / name).parent.mkdir(parents=True)
                (out / name).write_text("the only copy")
                for more in ((), ("--plan",), ("--summary-only",), ("--only", "a.off", "--no-summary")):
                    self.refused("batch", "meshes", "--out", "out", *more,
                                 naming=["out is not empty", "choose a new or an empty folder"])
                shutil.rmtree(out)

    def test_out_of_version_0_1_is_refused_clearly(self):
        self.meshes()
        self.batch("meshes", "out")
        (self.folder / "out" / LIST).unlink()
        self.refused("batch", "meshes", "--out", "out", *QUICK,
                     naming=["morsel 0.1", "choose a new or an empty folder"])

    def test_what_is_in_the_place_of_a_result_is_refused_before_the_work(self):
        self.meshes()
        self.batch("meshes", "out", "--only", "a.off", "--no-summary")
        for place in ("index.html", "summary.csv", "summary.json", "plots/histogram.svg",
                      "reports/b.off.json",
                      "state/b.off.json", "thumbnails/b.off.first.png", "thumbnails/b.off.last.png",
                      "pages/b.off.html",
                      "figures/b.off", "exports/b.off"):
            with self.subTest(place=place):
                path = self.folder / "out" / place
                (path.parent).mkdir(exist_ok=True)
                for make in (lambda: path.write_text("the only copy"), lambda: path.symlink_to("/nowhere/x"),
                             lambda: path.symlink_to(self.mesh)):
                    make()
                    self.refused("batch", "meshes", "--out", "out", *QUICK, "--html", "--figures", "--export",
                                 code=4,
                                 naming=[f"out/{place}"])
                    path.unlink()
        self.batch("meshes", "out", "--html", "--figures", "--export")

    def test_files_beside_results_stay(self):
        self.meshes()
        self.batch("meshes", "out", "--html", "--figures", "--export")
        theirs = ["notes.txt", "work/notes.txt", "figures/a.off/mine.png", "exports/a.off/deep/mine.vtp",
                  "plots/mine.svg",
                  "reports/mine.json", "state/mine.json", "pages/mine.html", ".hidden"]
        for name in theirs:
            (self.folder / "out" / name).parent.mkdir(exist_ok=True)
            (self.folder / "out" / name).write_text("the only copy")
        before = {name: kind for name, kind in contents(self.folder).items()
                  if name.startswith("meshes") or name.removeprefix("out/") in theirs}
        self.batch("meshes", "out", "--snap")  # takes pages, figures and exports away
        self.kept(before)
        self.assertEqual([path for path in (self.folder / "out/figures").rglob("*") if path.is_file()],
                         [self.folder / "out/figures/a.off/mine.png"])
        (self.folder / "meshes/a.off").write_text("OFF\n")
        before.pop("meshes/a.off")
        subprocess.run([PROGRAM, "batch", "meshes", "--out", "out", *QUICK], cwd=self.folder, check=False,
                       capture_output=True)
        self.assertFalse((self.folder / "out/reports/a.off.json").exists())
        self.kept(before)

    def test_nothing_behind_a_link_is_touched(self):
        """Everything behind OUT/work, if that was a link, was once removed."""
        self.meshes()
        self.meshes("kept")
        for place in (place for place in PLACES if place.endswith("/")):
            with self.subTest(place=place):
                self.batch("meshes", "out", "--only", "a.off", "--no-summary")
                link = self.folder / "out" / place.rstrip("/")
                shutil.rmtree(link, ignore_errors=True)
                link.symlink_to(self.folder / "kept")
                self.refused("batch", "meshes", "--out", "out", *QUICK, "--html", "--figures", "--export",
                             code=4,
                             naming=["symbolic link"])
                shutil.rmtree(self.folder / "out")

    def test_out_itself_may_be_a_link(self):
        self.meshes()
        (self.folder / "real").mkdir()
        (self.folder / "out").symlink_to("real")
        self.batch("meshes", "out")
        self.assertTrue((self.folder / "real/index.html").exists())
        self.assertIn("(2 by earlier runs)", self.batch("meshes", "out").stdout)

    def test_a_damaged_list_is_refused(self):
        self.meshes()
        self.batch("meshes", "out")
        good = (self.folder / "out" / LIST).read_text()
        for bad in (good + "+/etc/passwd\n", good + "+../meshes/a.off\n", good + "+x/../../meshes/a.off\n",
                    "[" * 100000 + "\n",
                    good.replace("results/1", "results/9"), good + "\n", good + "+a%00\n"):
            (self.folder / "out" / LIST).write_text(bad)
            self.refused("batch", "meshes", "--out", "out", *QUICK, code=3,
                         naming=[LIST, "choose a new or an empty folder"])
        (self.folder / "out" / LIST).write_text(good + "+reports/a.off.js")  # of a process that was killed
        self.batch("meshes", "out")
        self.assertEqual((self.folder / "out" / LIST).read_text().splitlines()[0], good.splitlines()[0])

    def test_a_name_with_no_room_for_endings_fails_alone(self):
        """A mesh with a name of 255 bytes once ended the batch, and every later one, with code 70."""
        folder = self.meshes()
        long = "x" * 251 + ".off"
        (folder / long).write_text(OCTAHEDRON)
        for _ in range(2):
            result = subprocess.run([PROGRAM, "batch", "meshes", "--out", "out", *QUICK], cwd=self.folder,
                                    text=True,
                                    capture_output=True, check=False)
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn("2 done, 1 failed", result.stdout)
            self.assertIn(f"{long}: failed: the name {long} has 255 bytes", result.stderr)
        summary = json.loads((self.folder / "out/summary.json").read_text())
        self.assertEqual(next(mesh["error"]["exit_code"] for mesh in summary["meshes"]
                              if mesh["name"] == long), 4)
        self.assertNotIn(long, self.morsel("batch", "meshes", "--out", "out", *QUICK, "--plan").stdout)
        self.morsel("batch", "meshes", "--out", "out", *QUICK, "--only", "y" * 300 + ".off", code=2)
        self.morsel("batch", "n" * 300, "--out", "out", *QUICK, code=3)
        self.morsel("batch", "meshes", "--out", "n" * 300, *QUICK, code=4)

    def test_links_in_a_collection_that_lead_nowhere_are_passed_over(self):
        folder = self.meshes()
        (folder / "loop.off").symlink_to("loop.off")
        (folder / "gone.off").symlink_to("nowhere.off")
        self.assertIn("2 meshes: 2 done", self.batch("meshes", "out").stdout)

    def test_a_plan_has_one_line_a_mesh(self):
        folder = self.meshes()
        names = ["a.off", "b.off", "line\nbreak\t\x7f.off", '"quoted".off', "back\\slash.off",
                 "new\n\"line\\.off", "\x9b31m\u202e.off", "umlaut-\u00fc.off"]
        for name in names:
            (folder / name).write_text(OCTAHEDRON)
        (folder / os.fsdecode(b"bytes\xff\n.off")).write_text(OCTAHEDRON)
        result = subprocess.run([PROGRAM, "batch", "meshes", "--out", "out", "--plan"], cwd=self.folder,
                                capture_output=True, check=True)
        rows = [line.split("\t") for line in os.fsdecode(result.stdout).splitlines()]
        self.assertEqual({len(row) for row in rows}, {2})
        self.assertNotRegex(os.fsdecode(result.stdout), "[\x80-\x9f\u202a-\u202e]")
        self.assertEqual({json.loads(name) if name.startswith('"') else name for _, name in rows},
                         {*names, os.fsdecode(b"bytes\xff\n.off")})
        self.assertFalse((self.folder / "out").exists())
        for name in names:
            self.batch("meshes", "out", "--only", name, "--no-summary")
        result = subprocess.run([PROGRAM, "batch", "meshes", "--out", "out", *QUICK], cwd=self.folder,
                                capture_output=True, check=False)
        self.assertIn(b"9 meshes: 9 done", result.stdout, result.stderr)

    def test_what_a_killed_run_leaves_is_listed_and_goes_with_the_next(self):
        self.meshes()
        process = subprocess.Popen([PROGRAM, "batch", "meshes", "--out", "out", "--method",
                                    "salient:iterations=1000000"],
                                   cwd=self.folder, stderr=subprocess.DEVNULL)
        until(lambda: list(self.folder.glob("out/work/*/*")))
        process.kill()
        process.wait()
        left, = (self.folder / "out/work").iterdir()
        self.assertIn(f"+work/{left.name}/", (self.folder / "out" / LIST).read_text().splitlines())
        (self.folder / "out/work/notes.txt").write_text("the only copy")
        self.batch("meshes", "out")
        self.assertEqual(list((self.folder / "out/work").iterdir()), [self.folder / "out/work/notes.txt"])

    def test_two_runs_at_once_begin_one_folder(self):
        self.meshes()
        for _ in range(5):
            processes = [subprocess.Popen([PROGRAM, "batch", "meshes", "--out", "out", *QUICK,
                                           "--no-thumbnails", *more],
                                          cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                          text=True)
                         for more in ((), ("--snap",), (), ("--no-items",))]
            for process in processes:
                _, errors = process.communicate(timeout=120)
                self.assertEqual(process.returncode, 0, errors)
            listed = (self.folder / "out" / LIST).read_text().splitlines()
            self.assertEqual(json.loads(listed[0]), {"schema": "morsel.results/1"})
            there = {str(path.relative_to(self.folder / "out")) for path in (self.folder / "out").rglob("*")
                     if path.is_file()}
            self.assertLessEqual(there - {LIST}, {name_in(line) for line in listed[1:]})
            shutil.rmtree(self.folder / "out")


class FileSystems(OwnershipTest):
    def batch(self, *arguments, **options):
        return subprocess.run([PROGRAM, "batch", *map(str, arguments), *QUICK], cwd=self.folder,
                              capture_output=True,
                              text=True, check=False, **options)

    def test_collection_and_out_on_other_file_systems(self):
        mounted = self.mounted()
        self.meshes()
        self.meshes("mounted/meshes")
        before = contents(self.folder)
        for collection, out in (("meshes", "mounted/out"), ("mounted/meshes", "out")):
            self.assertEqual(self.batch(collection, "--out", out, "--html", "--export").returncode, 0)
            self.assertIn("(2 by earlier runs)", self.batch(collection, "--out", out, "--html",
                                                            "--export").stdout)
        self.kept(before)
        self.refused("batch", "mounted/meshes", "--out", "mounted", *QUICK)
        (self.folder / "again").mkdir()
        bound = subprocess.run(["mount", "--bind", mounted / "meshes", self.folder / "again"], check=False,
                               capture_output=True)
        if bound.returncode == 0:
            self.addCleanup(subprocess.run, ["umount", "-l", self.folder / "again"], check=True)
            self.refused("batch", "mounted/meshes", "--out", "again/out", *QUICK)

    def test_what_is_mounted_in_a_left_work_folder_stays(self):
        self.meshes()
        self.assertEqual(self.batch("meshes", "--out", "out", "--only", "a.off", "--no-summary").returncode,
                         0)
        mounted = self.mounted()
        (mounted / "thesis.txt").write_text("the only copy")
        (self.folder / "out/work/killed/0").mkdir(parents=True)
        with open(self.folder / "out" / LIST, "a", encoding="utf-8") as listed:
            listed.write("+work/killed/\n")
        inner = self.folder / "out/work/killed/0"
        result = subprocess.run(["mount", "--bind", mounted, inner], check=False, capture_output=True,
                                text=True)
        if result.returncode != 0:
            self.skipTest(f"nothing can be mounted there: {result.stderr}")
        self.addCleanup(subprocess.run, ["umount", "-l", inner], check=True)
        self.assertEqual(self.batch("meshes", "--out", "out").returncode, 0)
        self.assertEqual((mounted / "thesis.txt").read_text(), "the only copy")

    def test_a_full_one(self):
        mounted = self.mounted()
        self.meshes()
        self.meshes("mounted/kept")
        self.assertEqual(self.batch("meshes", "--out", "mounted/out", "--only", "a.off",
                                    "--no-summary").returncode, 0)
        before = {name: kind for name, kind in contents(self.folder).items() if not name.endswith(LIST)}
        with open(mounted / "filling", "wb") as filling, self.assertRaises(OSError):
            while True:
                os.write(filling.fileno(), bytes(4096))
        for out in ("mounted/out", "mounted/new"):
            result = self.batch("meshes", "--out", out)
            self.assertEqual(result.returncode, 4, result.stderr)
            self.assertTrue(result.stderr.startswith("morsel: cannot "), result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            self.kept(before)
        self.assertEqual(contents(mounted / "new") if (mounted / "new").exists() else {}, {})
        (mounted / "filling").unlink()
        self.assertIn("(1 by earlier runs)", self.batch("meshes", "--out", "mounted/out").stdout)

    def test_a_read_only_one(self):
        mounted = self.mounted()
        self.meshes()
        self.meshes("mounted/kept")
        (mounted / "empty").mkdir()
        self.assertEqual(self.batch("meshes", "--out", "mounted/out").returncode, 0)
        subprocess.run(["mount", "-o", "remount,ro", mounted], check=True)
        for out in ("mounted/out", "mounted/new", "mounted/empty"):
            self.refused("batch", "meshes", "--out", out, *QUICK, code=4, naming=["Read-only"])
            self.refused("compare", "m.off", "--figures", out, *QUICK, code=4, naming=["Read-only"])
        self.assertEqual(self.batch("mounted/kept", "--out", "out").returncode, 0)

    def test_another_user_s(self):
        if os.geteuid() != 0:
            self.skipTest("only root may become another user")
        meshes = self.meshes()
        self.folder.chmod(0o755)
        self.assertEqual(self.batch("meshes", "--out", "out").returncode, 0)
        (self.folder / "empty").mkdir()
        program = self.folder / "morsel"
        shutil.copy(PROGRAM, program)  # which that user need not reach where it was built, as in /root
        other = {"user": NOBODY, "group": NOBODY, "extra_groups": (), "executable": str(program)}
        for out in ("out", "empty", "new"):
            self.refused("batch", meshes, "--out", out, *QUICK, code=4, naming=["ermission denied"], **other)
            self.refused("compare", "m.off", "--export", out, *QUICK, code=4, naming=["ermission denied"],
                         **other)
        shared = self.folder / "shared"
        shared.mkdir()
        shared.chmod(stat.S_ISVTX | 0o777)
        (shared / "thesis.txt").write_text("the only copy")
        self.refused("batch", meshes, "--out", "shared", *QUICK, **other)


class Folders(OwnershipTest):
    """Of compare, hierarchy, sweep and reproduce."""

    def commands(self, folder):
        data = self.folder / "data"
        data.mkdir(exist_ok=True)
        for name in ("lion", "squirrel", "protein"):
            shutil.copy(SAMPLES / "sphere.off", data / f"{name}.off")
        return {
            "figures": ("compare", "m.off", *QUICK, "--figures", folder, *SMALL),
            "export": ("compare", "m.off", *QUICK, "--export", folder),
            "levels": ("hierarchy", "m.off", "--levels", "0", "--export", folder),
            "stability": ("stability", "m.off", "--noise", "0.1", "--trials", "1", "--figures", folder),
            "sweep": ("sweep", "m.off", "--vary", "iterations=1..2", "--figures", folder),
            "reproduce": ("reproduce", folder, "--data", "data", "--size", "40x34", "--samples", "1")}

    def test_a_folder_that_is_not_morsels_is_refused(self):
        for name, command in self.commands("theirs").items():
            for file in ("thesis.txt", "conventional.png", "index.html", ".x"):
                with self.subTest(command=name, file=file):
                    (self.folder / "theirs").mkdir()
                    self.file(f"theirs/{file}", "the only copy")
                    self.refused(*command, naming=["theirs is not empty", "choose a new or an empty folder"])
                    shutil.rmtree(self.folder / "theirs")
        self.refused("compare", "m.off", "--figures", ".")
        self.refused("compare", "m.off", "--figures", "m.off")

    def test_a_folder_is_filled_again_and_what_else_is_in_it_stays(self):
        for name, command in self.commands("out").items():
            with self.subTest(command=name):
                self.morsel(*command)
                listed = (self.folder / "out" / LIST).read_bytes()
                there = {str(path.relative_to(self.folder / "out"))
                         for path in (self.folder / "out").rglob("*") if path.is_file()}
                self.assertEqual({name_in(line) for line in listed.decode().splitlines()[1:]}, there - {LIST})
                self.file("out/thesis.txt", "the only copy")
                before = contents(self.folder)
                self.morsel(*command)
                again = (self.folder / "out" / LIST).read_bytes()
                self.assertTrue(again.startswith(listed))
                self.assertEqual({name_in(line) for line in again.decode().splitlines()[1:]}, there - {LIST})
                self.assertEqual(set(contents(self.folder)), set(before))
                self.assertEqual((self.folder / "out/thesis.txt").read_text(), "the only copy")
                # a file of theirs in the place of one of these
                taken = sorted(there - {LIST})[0]
                (self.folder / "out" / LIST).write_bytes(listed.splitlines(keepends=True)[0])
                (self.folder / "out" / taken).write_text("the only copy")
                self.assertIn("morsel did not make", self.morsel(*command, code=4).stderr)
                self.assertEqual((self.folder / "out" / taken).read_text(), "the only copy")
                shutil.rmtree(self.folder / "out")

    def test_a_listed_name_does_not_give_away_a_file_of_the_user(self):
        """A file was replaced if only its name was listed."""
        command = ("compare", "m.off", *QUICK, "--figures", "d", *SMALL)
        words = ("bash", "-c", 'ulimit -f 1; exec "$@"', "-", PROGRAM, *command[:-1], "600x400")
        failed = subprocess.run(words, cwd=self.folder, check=False, capture_output=True)
        self.assertEqual(failed.returncode, 4, failed.stderr)
        own = self.folder / "d" / "conventional.diagram.svg"
        own.parent.mkdir(exist_ok=True)
        own.write_text("the only copy")
        result = subprocess.run([PROGRAM, *command], cwd=self.folder, check=False, capture_output=True)
        self.assertIn(result.returncode, (2, 4))
        self.assertEqual(own.read_text(), "the only copy")
        shutil.rmtree(own.parent)
        self.morsel(*command)
        for name in ("conventional.diagram.svg", "sheet.png"):
            with self.subTest(name=name):
                own = self.folder / "d" / name
                own.unlink()
                own.write_text("the only copy")
                self.morsel(*command, code=4)
                self.assertEqual(own.read_text(), "the only copy")
                own.unlink()
                self.morsel(*command)

    def test_a_run_that_fails_leaves_no_journal_and_no_folder(self):
        self.file("bad.off", "junk")
        for output in ("a/../b/r.json", "c/./d/r.json"):
            self.refused("compare", "bad.off", *QUICK, "-o", output, code=3)
        words = ("bash", "-c", 'ulimit -f 0; exec "$@"', "-", PROGRAM, "sweep", "m.off", "--field", "height",
                 "--vary", "iterations=1..3", "-o", "s.json")
        failed = subprocess.run(words, cwd=self.folder, check=False, capture_output=True)
        self.assertEqual(failed.returncode, 4, failed.stderr)
        self.assertFalse((self.folder / "s.json.journal").exists())

    def test_a_long_chain_has_figures_and_exports(self):
        """The names of its files were too long, which was found after the work and told otherwise."""
        self.morsel("compare", "m.off", "--method", "+".join(["conventional"] * 41), *SMALL, "--figures", "f",
                    "--export", "e")

    def test_a_copy_of_a_folder_is_filled_again(self):
        command = ("compare", "m.off", *QUICK, *SMALL, "--figures")
        self.morsel(*command, "d")
        shutil.copytree(self.folder / "d", self.folder / "copy")  # with the times
        self.morsel(*command, "copy")

    def test_a_link_in_a_folder_is_not_followed(self):
        for name, command in self.commands("out").items():
            with self.subTest(command=name):
                self.morsel(*command)
                for path in (self.folder / "out").iterdir():
                    if path.name != LIST:
                        path.unlink()
                        path.symlink_to(self.mesh)
                before = contents(self.folder)
                self.morsel(*command, code=4)
                self.kept({name: kind for name, kind in before.items() if not name.endswith(LIST)})
                shutil.rmtree(self.folder / "out")

    def test_options_may_share_a_folder(self):
        every = ("compare", "m.off", *QUICK, *SMALL, "--figures", "d", "--export")
        for other in ("d", "d/", "./d", "d/deeper"):
            with self.subTest(other=other):
                for _ in range(2):
                    self.morsel(*every, other, "-o", "d/report.json", "--html", "d/page.html", "--thumbnails",
                                "d/small")
                for name in ("sheet.png", "report.json", "page.html", "small.first.png"):
                    self.assertTrue((self.folder / "d" / name).exists())
                shutil.rmtree(self.folder / "d")
        self.morsel("compare", "m.off", *QUICK, *SMALL, "--export", "e", "--figures", "e/deeper")

    def test_an_output_in_the_place_of_a_result_is_not_lost(self):
        self.assertIn("another output", self.morsel("compare", "m.off", *QUICK, *SMALL, "--figures", "d",
                                                    "-o", "d/sheet.png",
                                                    code=4).stderr)
        self.assertIn("another output", self.morsel("compare", "m.off", *QUICK, "--export", "e", "--html",
                                                    "e/conventional.points.csv", code=4).stderr)
        self.morsel("compare", "m.off", *QUICK, "-o", f"d/{LIST}", code=2)


class Outputs(OwnershipTest):
    """Every command, with outputs that are an input or one another."""

    def names_of(self, path, ending):
        """Names by which a file is reached that end as an output has to."""
        stem = f"{path.stem}-{path.suffix[1:]}"
        soft, hard, far = (self.folder / f"{kind}-{stem}{ending}" for kind in ("soft", "hard", "far"))
        soft.symlink_to(path.name)
        far.symlink_to(soft)
        os.link(path, hard)
        names = [hard.name, f"./{far.name}"]
        if path.suffix == ending:
            names += [path.name, f"linked/{path.name}"]
        return names, (soft, hard, far)

    def test_no_output_is_an_input(self):
        """`compare m.off -o m.off` once replaced the mesh by JSON, `cut m.off -o m.off` by the cut."""
        (self.folder / "linked").symlink_to(".")
        for command, (words, options) in ON_MESH.items():
            words = [word.format(self.mesh.name) for word in words]
            required = ()
            if " -o " in self.usage(command):
                required = ("-o", f"free{options['-o']}")
            for option, ending in options.items():
                for inputs, more in ((self.mesh, ()), (self.values,
                                                       ("--field", "vertex-scalar:file=values.txt"))):
                    if more and "--field" in words:
                        words = words[:words.index("--field")]
                    names, made = self.names_of(inputs, ending)
                    for name in names:
                        with self.subTest(command=command, option=option, input=inputs.name, name=name):
                            self.refused(*words, *more, *(required if option != "-o" else ()), option, name,
                                         naming=[option, name, inputs.name])
                    for path in made:
                        path.unlink()

    def test_an_output_without_an_ending_is_compared_with_inputs_too(self):
        for name in ("m.off", "linked/m.off"):
            (self.folder / "linked").unlink(missing_ok=True)
            (self.folder / "linked").symlink_to(".")
            for option in ("-o", "--html", "--figures", "--export"):
                self.refused("compare", "m.off", option, name, naming=[option, "MESH"])
            self.refused("hierarchy", "m.off", "-o", name)
            self.refused("hierarchy", "m.off", "--export", name)
            self.refused("segment", "m.off", "-o", "s.ply", "--json", name)
            self.refused("quads", "m.off", "-o", "q.obj", "--json", name)
        self.file("s.first.png", OCTAHEDRON).rename(self.folder / "p.first.png")
        (self.folder / "p.off").symlink_to("p.first.png")
        self.refused("compare", "p.off", "--thumbnails", "p",
                     naming=["--thumbnails p.first.png", "MESH p.off"])

    def test_a_molecule_is_not_replaced_by_its_surface(self):
        atom = "ATOM      1  CA  GLY A   1       0.000   0.000   0.000  1.00  0.00           C\n"
        structure = self.file("m.pdb", atom)
        for ending in (".off", ".ply"):
            names, made = self.names_of(structure, ending)
            for name in names:
                self.refused("molecule", "m.pdb", "-o", name, naming=["FILE m.pdb"])
            for path in made:
                path.unlink()
        os.link(structure, self.folder / "m.txt")
        self.refused("field", "m.off", "--field", "atomic-density:structure=m.pdb", "-o", "m.txt",
                     naming=["atomic-density:structure m.pdb"])

    def test_no_output_is_another(self):
        """`compare -o x.json --html x.json` once kept only one of them."""
        (self.folder / "soft").symlink_to("x")
        (self.folder / "linked").symlink_to(".")
        for first, second in (("x", "x"), ("x", "./x"), ("x", "soft"), ("soft", "linked/x"),
                              (self.folder / "x", "x")):
            for exists in (False, True):
                if exists:
                    self.file("x", "the only copy")
                self.refused("compare", "m.off", "-o", first, "--html", second,
                             naming=["-o", "--html", "one file"])
                self.refused("segment", "m.off", "-o", "x.ply", "--json", "x.ply", naming=["-o", "--json"])
                (self.folder / "x").unlink(missing_ok=True)
        for ending in (".vertices.txt", ".faces.txt"):
            self.refused("segment", "m.off", "-o", "s.txt", "--json", f"s{ending}", naming=[f"s{ending}"])
        self.refused("cut", "m.off", "-o", "c.off", "--json", "c.off")
        self.refused("cut", "m.off", "-o", "c.off", "--graph", "g.vtp", "--json", "g.vtp",
                     naming=["--graph", "--json"])
        self.refused("quads", "m.off", "-o", "q.obj", "--json", "q.obj")
        self.refused("compare", "m.off", "-o", "p.first.png", "--thumbnails", "p",
                     naming=["--thumbnails p.first.png"])
        self.refused("compare", "m.off", "-o", "d", "--figures", "d", naming=["--figures d"])
        self.refused("hierarchy", "m.off", "-o", "d", "--export", "d", naming=["--export d"])
        self.refused("sweep", "m.off", "--vary", "iterations=1", "-o", "d.csv", "--figures", "d.csv.journal",
                     naming=["journal"])
        for kind in ("json", "csv"):
            mesh = self.file(f"s.{kind}.journal", OCTAHEDRON)
            os.link(mesh, self.folder / f"{kind}.off")
            self.refused("sweep", f"{kind}.off", "--vary", "iterations=1", "-o", f"s.{kind}",
                         naming=["journal"])
            self.refused("stability", f"{kind}.off", "-o", f"s.{kind}", naming=["journal"])

    def test_no_output_is_the_list_of_a_folder_through_a_link(self):
        """`-o x.json` once replaced the list that x.json was a link to."""
        self.morsel("compare", "m.off", *QUICK, "--export", "d")
        for name, target in (("x.json", f"d/{LIST}"), ("far.json", "x.json"), ("new.json", f"new/{LIST}")):
            (self.folder / name).symlink_to(target)
            self.refused("compare", "m.off", *QUICK, "-o", name, naming=[f"-o {name}", "list of files"])
        self.refused("compare", "m.off", *QUICK, "--html", f"d/{LIST}", naming=["--html"])
        self.morsel("compare", "m.off", *QUICK, "--export", "d")

    def test_devices_and_pipes_may_be_named_twice(self):
        self.morsel("compare", "m.off", *QUICK, "-o", "/dev/null", "--html", "/dev/null")
        self.morsel("cut", "m.off", "-o", "c.off", "--json", "/dev/null", "--graph", "g.vtp")
        self.morsel("compare", "m.off", *QUICK, "-o", "/dev/stdout", "--html", "/dev/stdout")
        result = subprocess.run(f"'{PROGRAM}' compare m.off {' '.join(QUICK)} -o /dev/stdout "
                                "--html /dev/stdout > both",
                                shell=True, cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        result = subprocess.run(f"'{PROGRAM}' compare m.off -o /dev/stdout >> m.off", shell=True,
                                cwd=self.folder,
                                capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 2)
        self.assertEqual(self.mesh.read_text(), OCTAHEDRON)

    def test_no_file_is_called_nothing(self):
        """`-o ''` was once no output at all."""
        for command, (words, options) in ON_MESH.items():
            words = [word.format(self.mesh.name) for word in words]
            for option in options:
                self.refused(*words, option, "", naming=["''"])
                self.refused(*words, f"{'--output' if option == '-o' else option}=")
            self.refused(words[0], "", *words[2:], naming=["''"])
        for arguments in (("compare", "m.off", "--figures", ""), ("compare", "m.off", "--export", ""),
                          ("compare", "m.off", "--thumbnails", ""), ("hierarchy", "m.off", "--export", ""),
                          ("stability", "m.off", "--figures", ""),
                          ("sweep", "m.off", "--vary", "iterations=1", "--figures", ""), ("reproduce", ""),
                          ("reproduce", "out", "--data", ""), ("batch", "", "--out", "out"),
                          ("batch", "meshes", "--out", ""),
                          ("molecule", "", "-o", "m.off"), ("molecule", "m.pdb", "-o", ""), ("info", ""),
                          ("check", "")):
            with self.subTest(arguments=arguments):
                self.refused(*arguments, naming=["''"])

    def test_other_names_are_written_as_ever(self):
        for command, (words, options) in ON_MESH.items():
            if command == "quads":
                continue  # needs another field
            words = [word.format(self.mesh.name) for word in words]
            with self.subTest(command=command):
                self.morsel(*words, *(word for option, ending in options.items()
                                      for word in (option, f"{command}{option}{ending}")))
                for option, ending in options.items():
                    self.assertTrue((self.folder / f"{command}{option}{ending}").exists())


if __name__ == "__main__":
    unittest.main()
