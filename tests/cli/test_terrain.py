"""Terrain: ESRI ASCII grids, and GeoTIFF where the program has it."""

import json
import struct
import subprocess
import unittest

from support import PROGRAM, ProgramTest

try:
    from osgeo import gdal, osr
    gdal.UseExceptions()
except ImportError:
    gdal = None

# Two peaks (90, 70), a basin (0) within, a pass between the peaks; rows from the north.
GRID = [[30, 30, 30, 30, 30, 30],
        [30, 90, 40, 40, 70, 30],
        [30, 50, 60, 50, 50, 30],
        [30, 40, 0, 10, 40, 30],
        [30, 39, 38, 37, 36, 30],
        [30, 30, 30, 30, 30, 30]]


def asc(grid, no_data=-9999, corner=(1000, 2000), side=10):
    head = (f"ncols {len(grid[0])}\nnrows {len(grid)}\nxllcorner {corner[0]}\nyllcorner {corner[1]}\n"
            f"cellsize {side}\nNODATA_value {no_data}\n")
    return head + "".join(" ".join(map(str, row)) + "\n" for row in grid)


def float_tiff(grid, no_data=-9999, corner=(1000, 2000), side=10):
    """A GeoTIFF of one strip, made by hand."""
    rows, columns = len(grid), len(grid[0])
    data = struct.pack(f"<{rows * columns}f", *(value for row in grid for value in row))
    extra = []  # tag, type, values

    def entry(tag, kind, values):
        extra.append((tag, kind, values))

    entry(256, 3, [columns])
    entry(257, 3, [rows])
    entry(258, 3, [32])
    entry(259, 3, [1])
    entry(262, 3, [1])
    entry(273, 4, [8])
    entry(277, 3, [1])
    entry(278, 3, [rows])
    entry(279, 4, [len(data)])
    entry(339, 3, [3])
    entry(33550, 12, [float(side), float(side), 0.0])
    entry(33922, 12, [0.0, 0.0, 0.0, float(corner[0]), float(corner[1] + rows * side), 0.0])
    entry(34735, 3, [1, 1, 0, 1, 1024, 0, 1, 1])  # a projected system
    entry(42113, 2, str(no_data) + "\0")
    place = 8 + len(data)
    far = place + 2 + 12 * len(extra) + 4
    directory, behind = struct.pack("<H", len(extra)), b""
    for tag, kind, values in extra:
        packed = (values.encode() if kind == 2 else
                  struct.pack("<%d%s" % (len(values), {3: "H", 4: "I", 12: "d"}[kind]), *values))
        directory += struct.pack("<HHI", tag, kind, len(values))
        if len(packed) <= 4:
            directory += packed.ljust(4, b"\0")
        else:
            directory += struct.pack("<I", far + len(behind))
            behind += packed + b"\0" * (len(packed) % 2)
    return struct.pack("<2sHI", b"II", 42, place) + data + directory + struct.pack("<I", 0) + behind


class Terrain(ProgramTest):
    def values(self, mesh, field):
        self.morsel("field", mesh, "--field", field, "-o", "values.txt", "--quiet")
        return [float(line) for line in (self.folder / "values.txt").read_text().splitlines()
                if not line.startswith("#")]

    def with_geotiff(self):
        """Whether the program has it; without, it must say what is needed."""
        (self.folder / "t.tif").write_bytes(float_tiff(GRID))
        result = self.morsel("info", "t.tif", code=None)
        if result.returncode == 2:
            self.assertIn("this morsel was built without GeoTIFF: build it with -DMORSEL_WITH_GEOTIFF=ON, "
                          "for which the package libgdal-dev is needed", result.stderr)
            return False
        return True

    def morsel(self, *arguments, code=0, **options):
        if code is None:
            return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, cwd=self.folder,
                                  check=False)
        return super().morsel(*arguments, code=code, **options)

    def test_peaks_and_basins(self):
        self.file("t.asc", asc(GRID))
        flat = [value for row in GRID for value in row]
        self.assertEqual(self.values("t.asc", "height"), flat)
        self.assertEqual(self.values("t.asc", "vertex-scalar:property=elevation"), flat)
        self.assertEqual(self.values("t.asc", "height:axis=x")[:6], [1005, 1015, 1025, 1035, 1045, 1055])
        self.assertEqual(self.values("t.asc", "height:axis=y")[::6], [2055, 2045, 2035, 2025, 2015, 2005])
        self.morsel("compare", "t.asc", "--field", "height", "--method", "conventional", "-o", "r.json")
        report = json.loads((self.folder / "r.json").read_text())
        points = report["methods"][0]["critical_points"]
        self.assertEqual(points["maxima"], 2)
        # Turned upside down, peaks are minima, and the boundary is below none of them.
        self.morsel("compare", "t.asc", "--field", "height:direction=0/0/-1", "--method", "conventional",
                    "-o", "d.json")
        points = json.loads((self.folder / "d.json").read_text())["methods"][0]["critical_points"]
        self.assertGreaterEqual(points["minima"], 2)

    def test_gaps_are_warned_of(self):
        grid = [[5 * i + j for j in range(5)] for i in range(5)]
        grid[2][2] = -9999
        self.file("gap.asc", asc(grid))
        info = json.loads(self.morsel("info", "--json", "gap.asc").stdout)
        self.assertTrue(info["valid"])
        self.assertEqual(info["mesh"]["vertices"], 24)
        self.assertEqual(info["mesh"]["boundary_loops"], 2)
        self.assertEqual(info["mesh"]["warnings"], ["1 of 25 cells have no data and are left out"])

    def test_a_made_tiff_is_the_grid(self):
        if not self.with_geotiff():
            return
        self.file("t.asc", asc(GRID))
        for field in ("height", "height:axis=x", "height:axis=y", "vertex-scalar:property=elevation"):
            self.assertEqual(self.values("t.tif", field), self.values("t.asc", field))
        holes = [[1, 2, 3], [4, -9999, 6], [7, 8, 9]]
        (self.folder / "h.tif").write_bytes(float_tiff(holes))
        self.file("h.asc", asc(holes))
        self.assertEqual(self.values("h.tif", "height"), self.values("h.asc", "height"))

    def test_damaged_tiffs_are_refused_in_silence_of_gdal(self):
        if not self.with_geotiff():
            return
        whole = float_tiff(GRID)
        for length in range(0, len(whole), 7):
            (self.folder / "cut.tif").write_bytes(whole[:length])
            result = self.morsel("info", "cut.tif", code=None)
            self.assertIn(result.returncode, (0, 3))
            if result.returncode == 3:
                self.assertRegex(result.stderr, r"\Amorsel: cannot read \"cut.tif\": [^\n]*\n\Z")
        (self.folder / "text.tif").write_bytes(b"no TIFF at all")
        self.assertIn("no TIFF file that GDAL can read", self.morsel("info", "text.tif", code=3).stderr)

    def test_tiffs_of_gdal(self):
        if gdal is None or not self.with_geotiff():
            return
        driver = gdal.GetDriverByName("GTiff")

        def write(name, grid, kind, options=(), geo=(100, 2, 0, 500, 0, -2), no_data=None, bands=1,
                  epsg=None, **more):
            dataset = driver.Create(str(self.folder / name), len(grid[0]), len(grid), bands, kind,
                                    list(options))
            if geo:
                dataset.SetGeoTransform(geo)
            if epsg:
                system = osr.SpatialReference()
                system.ImportFromEPSG(epsg)
                dataset.SetProjection(system.ExportToWkt())
            band = dataset.GetRasterBand(1)
            if no_data is not None:
                band.SetNoDataValue(no_data)
            if "scale" in more:
                band.SetScale(more["scale"])
                band.SetOffset(more["offset"])
            code = {gdal.GDT_Byte: "B", gdal.GDT_Int16: "h", gdal.GDT_Float32: "f",
                    gdal.GDT_Float64: "d"}[kind]
            flat = [v for row in grid for v in row]
            band.WriteRaster(0, 0, len(grid[0]), len(grid), struct.pack(f"<{len(flat)}{code}", *flat))
            dataset.FlushCache()
            dataset = None

        flat = [value for row in GRID for value in row]
        big = [[(37 * r + 11 * c) % 101 for c in range(70)] for r in range(45)]
        tiles = ["TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16"]
        for name, kind, options in (
                ("a.tif", gdal.GDT_Int16, ["COMPRESS=DEFLATE"]), ("b.tiff", gdal.GDT_Float64, tiles),
                # Not both: GDAL 3.6 does not read its own files of that kind right.
                ("c.tif", gdal.GDT_Float32, ["COMPRESS=LZW", "PREDICTOR=3"]),
                ("d.tif", gdal.GDT_Float32, ["COMPRESS=LZW", "ENDIANNESS=BIG"])):
            write(name, big, kind, options)
            self.assertEqual(self.values(name, "height"), [v for row in big for v in row])
            self.assertEqual(self.values(name, "height:axis=x")[:3], [101, 103, 105])
            self.assertEqual(self.values(name, "height:axis=y")[:3], [499, 499, 499])
        write("n.tif", GRID, gdal.GDT_Int16, no_data=90)
        # The corner's triangle meets the rest in two cells of height 30, which are split.
        self.assertEqual(sorted(self.values("n.tif", "height")),
                         sorted([v for v in flat if v != 90] + [30, 30]))
        write("s.tif", GRID, gdal.GDT_Int16, scale=0.5, offset=100)
        self.assertEqual(self.values("s.tif", "height"), [100 + v / 2 for v in flat])
        write("r.tif", GRID, gdal.GDT_Int16, geo=(100, 3, 4, 500, 4, -3))
        self.assertEqual(self.values("r.tif", "height:axis=x")[:2], [103.5, 106.5])
        write("d.tif", GRID, gdal.GDT_Int16, geo=(8, 0.01, 0, 47, 0, -0.01), epsg=4326)
        self.assertEqual(self.values("d.tif", "height"), flat)
        write("p.tif", [[v % 200 for v in row] for row in GRID], gdal.GDT_Byte, ["PHOTOMETRIC=RGB"], bands=3)
        self.assertIn("it is a picture, not a terrain", self.morsel("info", "p.tif", code=3).stderr)


if __name__ == "__main__":
    unittest.main()
