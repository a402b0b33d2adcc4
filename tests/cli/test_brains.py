"""FreeSurfer's and GIFTI's files: read and written as nibabel does it; a made cortex from surface and sulc to
pits, basins and an annotation."""

import itertools
import json
import struct
import unittest

import numpy as np
from cortex import cortex, maxima
from support import ProgramTest, data_lines

try:
    import nibabel
    import nibabel.freesurfer as freesurfer
except ImportError as error:
    raise unittest.SkipTest("nibabel (Debian's python3-nibabel) is not installed") from error

POINTSET, TRIANGLE = "NIFTI_INTENT_POINTSET", "NIFTI_INTENT_TRIANGLE"


def numbers(path, kind=float):
    return np.array([kind(line) for line in data_lines(path)])


def gifti_array(values, intent, **options):
    return nibabel.gifti.GiftiDataArray(values, intent=intent,
                                        datatype="NIFTI_TYPE_INT32" if values.dtype.kind == "i"
                                        else "NIFTI_TYPE_FLOAT32", **options)


class Brains(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.points, cls.faces, cls.sulc = cortex(4)

    def surface(self, name="lh.white", **options):
        freesurfer.write_geometry(self.folder / name, self.points, self.faces, **options)
        return name

    def overlay(self, name="lh.sulc", values=None):
        freesurfer.write_morph_data(self.folder / name, self.sulc if values is None else values,
                                    len(self.faces))
        return name

    def gifti(self, name, *arrays):
        image = nibabel.gifti.GiftiImage(darrays=list(arrays))
        nibabel.save(image, self.folder / name)
        return name

    def height(self, mesh, axis):
        self.morsel("field", mesh, "--field", f"height:axis={axis}", "-o", "h.txt")
        return numbers(self.folder / "h.txt")

    def check_surface(self, mesh, points=None):
        points = self.points if points is None else points
        document = json.loads(self.morsel("info", mesh, "--json").stdout)
        self.assertEqual((document["mesh"]["vertices"], document["mesh"]["faces"], document["defects"]),
                         (len(self.points), len(self.faces), []))
        for axis, name in enumerate("xyz"):
            np.testing.assert_array_equal(self.height(mesh, name), points[:, axis].astype(float))

    def test_surfaces_of_freesurfer_are_read_as_nibabel_reads_them(self):
        self.check_surface(self.surface())
        self.check_surface(self.surface("rh.sphere.reg"))
        self.check_surface(self.surface("named_by_nobody"))
        geometry = {"head": np.array([2, 0, 20], np.int32), "valid": "1  # volume info valid",
                    "filename": "orig.mgz", "volume": np.array([256, 256, 256]),
                    "voxelsize": np.ones(3), "xras": np.array([-1., 0, 0]), "yras": np.array([0., 0, -1]),
                    "zras": np.array([0., 1, 0]), "cras": np.array([5., 6, 7])}
        self.check_surface(self.surface("lh.pial", volume_info=geometry, create_stamp="made up"))

    def test_old_surfaces_of_quads_are_read_as_nibabel_reads_them(self):
        corners = np.array(list(itertools.product((0, 1), repeat=3)))
        quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]

        def three_bytes(*values):
            return b"".join(struct.pack(">I", value)[1:] for value in values)
        for magic, places in ((0xFFFFFF, (123 * corners).astype(">i2")),
                              (0xFFFFFD, (1.23 * corners).astype(">f4"))):
            (self.folder / "lh.orig").write_bytes(three_bytes(magic, 8, 6) + places.tobytes()
                                                  + three_bytes(*sum(quads, [])))
            expected, faces = freesurfer.read_geometry(self.folder / "lh.orig")
            for axis, name in enumerate("xyz"):
                np.testing.assert_array_equal(self.height("lh.orig", name), expected[:, axis])
            document = json.loads(self.morsel("info", "lh.orig", "--json").stdout)
            self.assertEqual((document["mesh"]["faces"], document["mesh"]["euler_characteristic"]),
                             (len(faces), 2))

    def test_surfaces_of_gifti_are_read_in_every_encoding(self):
        for encoding in ("ASCII", "B64BIN", "B64GZ"):
            for endian in ("little", "big"):
                options = {"encoding": f"GIFTI_ENCODING_{encoding}", "endian": endian}
                mesh = self.gifti("lh.pial.surf.gii", gifti_array(self.points, POINTSET, **options),
                                  gifti_array(self.faces, TRIANGLE, **options))
                # As text nibabel writes six decimals.
                self.check_surface(mesh, nibabel.load(self.folder / mesh).darrays[0].data)

    def check_values(self, expected, file, *more):
        mesh = self.surface()
        keys = ",".join([f"file={file}", *more])
        self.morsel("field", mesh, "--field", f"vertex-scalar:{keys}", "-o", "values.txt")
        np.testing.assert_array_equal(numbers(self.folder / "values.txt"), np.asarray(expected, float))

    def test_values_of_freesurfer_are_read_as_nibabel_reads_them(self):
        self.check_values(self.sulc, self.overlay())
        self.check_values(self.sulc, self.overlay("rh.any_name"))
        hundredths = np.round(100 * self.sulc).astype(">i2")
        count = struct.pack(">I", len(self.sulc))[1:]
        (self.folder / "lh.curv").write_bytes(count + count + hundredths.tobytes())
        self.check_values(freesurfer.read_morph_data(self.folder / "lh.curv"), "lh.curv")

    def test_values_of_gifti_are_chosen_by_column(self):
        first = gifti_array(self.sulc, "NIFTI_INTENT_SHAPE", meta=nibabel.gifti.GiftiMetaData(Name="sulc"))
        second = gifti_array(-self.sulc, "NIFTI_INTENT_SHAPE", meta=nibabel.gifti.GiftiMetaData(Name="curv"))
        self.check_values(self.sulc, self.gifti("one.shape.gii", first))
        two = self.gifti("two.func.gii", first, second)
        self.check_values(self.sulc, two, "column=sulc")
        self.check_values(-self.sulc, two, "column=2")
        error = self.morsel("field", "lh.white", "--field", f"vertex-scalar:file={two}", "-o", "x.txt",
                            code=3).stderr
        self.assertIn('1 "sulc", 2 "curv"', error)
        whole = self.gifti("whole.gii", gifti_array(self.points, POINTSET), gifti_array(self.faces, TRIANGLE),
                           first)
        self.morsel("field", whole, "--field", "vertex-scalar:property=sulc", "-o", "values.txt")
        np.testing.assert_array_equal(numbers(self.folder / "values.txt"), self.sulc.astype(float))

    def test_a_field_is_written_as_gifti(self):
        mesh = self.surface()
        for name, intent in (("x.shape.gii", "NIFTI_INTENT_SHAPE"), ("x.func.gii", "NIFTI_INTENT_NONE")):
            self.morsel("field", mesh, "-o", name)
            self.morsel("field", mesh, "-o", "x.txt")
            array, = nibabel.load(self.folder / name).darrays
            self.assertEqual(nibabel.nifti1.intent_codes.niistring[array.intent], intent)
            self.assertEqual(array.meta["Name"], "mean-curvature")
            np.testing.assert_array_equal(array.data, numbers(self.folder / "x.txt").astype(np.float32))
            self.check_values(array.data, name)

    def test_from_surface_and_sulc_to_pits_basins_and_annotation(self):
        mesh, field = self.surface(), f"vertex-scalar:file={self.overlay()}"
        pits = maxima(self.faces, self.sulc)
        found = json.loads(self.morsel("points", mesh, "--field", field, "--kind", "maxima", "--fill", "none",
                                       "--spacing", "0", "--points", "10000", "-o", "-").stdout)
        self.assertEqual(sorted(point["vertex"] for point in found["points"]), pits.tolist())

        for wanted in (None, 12):
            merge = [] if wanted is None else ["--segments", wanted]
            for name in ("b.txt", "lh.b.annot", "b.label.gii"):
                self.morsel("segment", mesh, "--field", field, *merge, "-o", name)
            labels = numbers(self.folder / "b.vertices.txt", int)
            count = len(pits) if wanted is None else wanted
            self.assertEqual(set(labels), set(range(count)))
            if wanted is None:
                self.assertEqual(len(set(labels[pits])), count)  # a basin around each pit

            read, table, names = freesurfer.read_annot(self.folder / "lh.b.annot")
            np.testing.assert_array_equal(read, labels)
            self.assertEqual([name.decode() for name in names], [f"segment_{i}" for i in range(count)])
            self.assertEqual(len(np.unique(table[:, :3], axis=0)), count)
            self.assertTrue((table[:, 3] == 0).all() and table[:, :3].any(axis=1).all())
            self.check_values(labels, "lh.b.annot")

            image = nibabel.load(self.folder / "b.label.gii")
            np.testing.assert_array_equal(image.darrays[0].data, labels)
            self.assertEqual(image.labeltable.get_labels_as_dict(),
                             {-1: "???", **{i: f"segment_{i}" for i in range(count)}})
            self.check_values(labels, "b.label.gii")

    def test_a_vertex_without_label_is_unknown(self):
        points = np.concatenate([self.points, [[0, 0, 0]]])  # which no face has
        freesurfer.write_geometry(self.folder / "lh.white", points, self.faces)
        for name in ("b.txt", "b.annot", "b.label.gii"):
            self.morsel("segment", "lh.white", "--repair", "--segments", 5, "-o", name)
        labels = numbers(self.folder / "b.vertices.txt", int)
        self.assertEqual(labels[-1], -1)
        np.testing.assert_array_equal(freesurfer.read_annot(self.folder / "b.annot")[0], labels)
        np.testing.assert_array_equal(nibabel.load(self.folder / "b.label.gii").darrays[0].data, labels)

    def test_an_annotation_of_nibabel_is_read(self):
        labels = np.arange(len(self.sulc)) % 4 - 1
        table = np.array([[25, 5, 25, 0], [0, 0, 200, 0], [200, 1, 0, 0]])
        freesurfer.write_annot(self.folder / "lh.a.annot", labels, table, ["unknown", "a", "b"])
        self.check_values(labels, "lh.a.annot")

    def test_a_collection_has_surfaces_without_their_values(self):
        (self.folder / "surf").mkdir()
        self.surface("surf/lh.white")
        self.overlay("surf/lh.sulc")
        self.gifti("surf/lh.sulc.shape.gii", gifti_array(self.sulc, "NIFTI_INTENT_SHAPE"))
        self.morsel("batch", "surf", "--out", "out", "--plan", "--method", "conventional")
        self.morsel("batch", "surf", "--out", "out", "--method", "conventional", "--no-thumbnails")
        summary = json.loads((self.folder / "out/summary.json").read_text())
        self.assertEqual([mesh["mesh"]["path"] for mesh in summary["meshes"]], ["surf/lh.white"])

    def refuse(self, words, *arguments):
        error = self.morsel(*arguments, code=3).stderr
        for word in words:
            self.assertIn(word, error)

    def test_what_is_no_surface_is_named(self):
        self.overlay()
        self.overlay("lh.pial")
        self.refuse(["lh.pial", "values for the vertices"], "info", "lh.pial")
        shape = self.gifti("s.gii", gifti_array(self.sulc, "NIFTI_INTENT_SHAPE"))
        self.refuse(["s.gii", "no surface", "NIFTI_INTENT_SHAPE"], "info", shape)
        self.file("lh.white", "no surface at all\n")
        self.refuse(["lh.white", "ff ff fe"], "info", "lh.white")
        external = self.gifti("e.gii", gifti_array(self.points, POINTSET), gifti_array(self.faces, TRIANGLE))
        text = (self.folder / external).read_text()
        (self.folder / external).write_text(text.replace("GZipBase64Binary", "ExternalFileBinary"))
        self.refuse(["e.gii", "ExternalFileBinary", "another file"], "info", external)
        self.refuse(["no surface", "vertex-scalar"], "compare", shape)

    def test_outputs_have_names_of_their_kind(self):
        mesh = self.surface()
        for name in ("b.gii", "b.shape.gii", "b.curv"):
            said = self.morsel("segment", mesh, "-o", name, code=2).stderr
            self.assertIn(".annot, .label.gii or .glb", said)
        for name in ("b.gii", "b.label.gii", "b.annot"):
            self.assertIn(".shape.gii or .func.gii", self.morsel("field", mesh, "-o", name, code=2).stderr)

    def test_the_number_of_values_is_that_of_the_vertices(self):
        mesh, short = self.surface(), self.overlay("lh.short", self.sulc[:-1])
        self.refuse(["lh.short", str(len(self.sulc) - 1), str(len(self.sulc))], "field", mesh, "--field",
                    f"vertex-scalar:file={short}", "-o", "x.txt")


if __name__ == "__main__":
    unittest.main()
