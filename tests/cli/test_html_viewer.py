"""The page of compare --html in a real browser: it loads without messages, draws, turns,
selects, and is accessible."""

import html
import json
import unittest

from browser import Browser
from support import OCTAHEDRON, SAMPLES, ProgramTest

# Draws, and returns of the pixels: the share that is covered, the number of colours among them, and a hash of
# all.
DRAWN = """(() => {
  const {viewer} = morsel, gl = viewer.renderer.getContext();
  viewer.drawNow();
  const width = gl.drawingBufferWidth, height = gl.drawingBufferHeight;
  const pixels = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  const colors = new Set();
  let covered = 0, hash = 0;
  for (let i = 0; i < pixels.length; i += 4) {
    const color = pixels[i] | pixels[i + 1] << 8 | pixels[i + 2] << 16;
    if (pixels[i + 3] > 0) { ++covered; colors.add(color); }
    hash = (Math.imul(hash, 31) + color + pixels[i + 3]) | 0;
  }
  return {covered: covered / (width * height), colors: colors.size, hash};
})()"""


class Viewer(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)

    def page(self, *arguments, name="page.html", **settings):
        self.morsel("compare", *arguments, "--html", name)
        page = self.browser.open(self.folder / name, **settings)
        self.addCleanup(page.close)
        self.assertEqual(page.run("document.body.dataset.state"), "ready", page.said())
        return page

    def lion(self, **settings):
        return self.page(SAMPLES / "lion-head.off", "--method", "conventional", "--method", "salient",
                         **settings)

    def box(self, page, expression):
        """Left, top, width and height of an element in the window."""
        return page.run(f"(() => {{ const b = ({expression}).getBoundingClientRect();"
                        " return [b.left, b.top, b.width, b.height]; })()")

    def assert_quiet(self, page):
        self.assertEqual(page.said(), [])
        self.assertEqual(page.requests(), [page.url])
        self.assertTrue(page.run("document.getElementById('problem').hidden"))

    def choose(self, page, control, value):
        """Sets a control as its user would, events included."""
        page.run(f"""(() => {{ const e = document.getElementById({json.dumps(control)});
            if (e.type === 'checkbox') {{ if (e.checked !== {json.dumps(value)}) e.click(); return; }}
            e.value = {json.dumps(value)};
            for (const kind of ['input', 'change'])
              e.dispatchEvent(new Event(kind, {{bubbles: true}})); }})()""")

    def test_models_are_drawn_and_controls_change_them(self):
        page = self.lion()
        first = page.run(DRAWN)
        self.assertGreater(first["covered"], 0.1)
        self.assertGreater(first["colors"], 200)
        self.assertEqual(page.run(DRAWN)["hash"], first["hash"])
        self.assertIn("462 minima, 934 saddles, 499 maxima",
                      page.run("document.getElementById('views').textContent"))

        # the slider: fewer points the further it goes, at its end only essential ones
        before, hashes = 10 ** 9, {first["hash"]}
        for value in (400, 800, 1000):
            self.choose(page, "threshold", value)
            count = page.run("""(() => { const {state, viewer} = morsel, view = viewer.views[0];
                return view.method.points.ranking.filter((i) => view.isShown(state, i)).length; })()""")
            self.assertLess(count, before)
            self.assertEqual(page.run("morsel.viewer.views[0].spheres.geometry.drawRange.count"), 1 + count)
            before = count
            hashes.add(page.run(DRAWN)["hash"])
        self.assertEqual(len(hashes), 4)
        self.assertEqual(before, 1)  # the lion has a boundary: no maximum is essential, its lowest minimum is
        self.assertIn("1 minima, 0 saddles, 0 maxima",
                      page.run("document.getElementById('views').textContent"))
        self.choose(page, "threshold", 0)
        self.assertEqual(page.run(DRAWN)["hash"], first["hash"])

        # every other control, one after the other, each alone
        for control, value, back in (("surface", "ascending", "field"), ("surface", "descending", "field"),
                                     ("surface", "cells", "field"), ("surface", "plain", "field"),
                                     ("minima", False, True), ("saddles", False, True),
                                     ("maxima", False, True),
                                     ("descending-arcs", True, False), ("ascending-arcs", True, False),
                                     ("size", 6, 0), ("same-scale", True, False), ("direction", "-x", "+z"),
                                     ("show-1", False, True)):
            self.choose(page, control, value)
            self.assertNotEqual(page.run(DRAWN)["hash"], first["hash"], control)
            self.choose(page, control, back)
            if control == "show-1":  # a view is as wide as there is room
                page.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
            self.assertEqual(page.run(DRAWN)["hash"], first["hash"], control)
        self.choose(page, "frame-time", True)
        page.run(DRAWN)
        self.assertRegex(page.run("document.getElementById('frame').textContent"),
                         r"^\d+\.\d ms, [\d,]+ triangles")
        self.assert_quiet(page)

    def test_chosen_points_are_shown_alone(self):
        page = self.page(SAMPLES / "lion-head.off", "--method", "conventional", "--method", "salient",
                         "--points", 12)
        report = page.run("morsel.page.report.methods.map(({chosen}) => chosen.points)")
        captions = page.run("[...document.querySelectorAll('.caption small')].map((e) => e.textContent)")
        for points, caption in zip(report, captions):
            counts = [sum(p["type"] == kind for p in points) for kind in ("minimum", "saddle", "maximum")]
            self.assertEqual(sum(counts), 12)
            self.assertEqual(caption, "{} minima, {} saddles, {} maxima".format(*counts))
        shown = page.run("""morsel.viewer.views.map((view) => view.method.points.ranking
            .filter((i) => view.isShown(morsel.state, i)).map((i) => view.method.points.vertex[i]))""")
        self.assertEqual([sorted(vertices) for vertices in shown],
                         [sorted(p["vertex"] for p in points) for points in report])
        self.assertIn("percentile", page.run("document.getElementById('summary').textContent"))
        few = page.run(DRAWN)
        self.choose(page, "only-chosen", False)
        self.assertNotEqual(page.run(DRAWN)["hash"], few["hash"])
        self.assertIn("462 minima, 934 saddles, 499 maxima",
                      page.run("document.getElementById('views').textContent"))
        self.choose(page, "only-chosen", True)
        self.assertEqual(page.run(DRAWN)["hash"], few["hash"])
        self.assert_quiet(page)
        without = self.lion()
        self.assertTrue(without.run("document.getElementById('only-chosen').closest('label').hidden"))

    def test_a_click_selects_and_a_drag_turns(self):
        page = self.lion()
        page.run("document.getElementById('views').scrollIntoView()")
        page.run(DRAWN)
        # the most persistent points of the second model that can be seen
        places = page.run("""(() => { const {viewer} = morsel, {points} = viewer.views[1].method;
            return points.ranking.map((i) =>
                ({i, vertex: points.vertex[i], type: points.type[i], ...viewer.placeOnPage(1, i)}))
              .filter((p) => !p.hidden).slice(0, 5); })()""")
        self.assertEqual(len(places), 5)
        for place in places[:3]:
            page.click(place["x"], place["y"])
            self.assertEqual(page.run("morsel.state.selected"), {"method": 1, "point": place["i"]})
            text = page.run("document.getElementById('selected').innerText")
            self.assertIn(["", "minimum", "saddle", "maximum"][place["type"]] + " of salient", text)
            self.assertRegex(text, rf"vertex\s+{place['vertex']}\b")
            for word in ("value", "persistence", "origin", "paired with", "conventional: "):
                self.assertIn(word, text)
            self.assertRegex(text, "conventional: (kept at|moved to|gone)")
        hidden = page.run("""(() => { const {viewer} = morsel, {points} = viewer.views[0].method;
            return points.ranking.map((i) => viewer.placeOnPage(0, i))
              .filter((p) => p.hidden).length; })()""")
        self.assertGreater(hidden, 100)
        box = self.box(page, "morsel.viewer.views[1].area")
        page.click(box[0] + box[2] - 4, box[1] + box[3] / 2)
        self.assertIsNone(page.run("morsel.state.selected"))

        cameras = "morsel.viewer.views.map((v) => [...v.orbit.rotation.toArray(), v.orbit.distance].join())"
        start = page.run(cameras)
        middle = (box[0] + box[2] / 2, box[1] + box[3] / 2)
        page.drag(middle, (middle[0] + 90, middle[1] + 30))
        linked = page.run(cameras)
        self.assertNotEqual(linked[1], start[1])
        self.assertEqual(linked[0], linked[1])
        self.assertIsNone(page.run("morsel.state.selected"))  # that was no click
        self.choose(page, "linked", False)
        page.mouse("mouseWheel", *middle, deltaX=0, deltaY=-200)
        alone = page.run(cameras)
        self.assertEqual(alone[0], linked[0])
        self.assertNotEqual(alone[1], linked[1])
        self.assert_quiet(page)

    def test_curves_show_their_values(self):
        page = self.lion()
        page.run("document.getElementById('curves').scrollIntoView()")
        box = self.box(page, "document.querySelector('#curves svg')")
        page.mouse("mouseMoved", box[0] + box[2] / 2, box[1] + box[3] / 2)
        self.assertRegex(page.run("document.querySelector('#curves .readout').textContent"),
                         r"persistence [\d.e−-]+: conventional \d+, salient \d+")
        page.run("document.querySelectorAll('#curves svg[tabindex]')[1].focus()")
        for _ in range(10):
            page.press("ArrowRight")
        self.assertEqual(page.run("document.querySelectorAll('#curves .readout')[1].textContent"),
                         "iteration 10: salient 97")
        page.run("document.querySelectorAll('#diagrams svg[tabindex]')[1].focus()")
        page.press("ArrowRight")
        self.assertRegex(page.run("document.querySelectorAll('#diagrams .readout')[1].textContent"),
                         r"^(minimum|saddle) \d+ at .*, (saddle|maximum) \d+ at .*: persistence ")
        page.press("Enter")
        self.assertEqual(page.run("morsel.state.selected.method"), 1)
        plots = "document.getElementById('diagrams').innerHTML + document.getElementById('curves').innerHTML"
        drawn = page.run(plots)
        for control, value in (("log", False), ("diagram-kind", "persistence"), ("log", True)):
            before = drawn
            self.choose(page, control, value)
            drawn = page.run(plots)
            self.assertNotEqual(drawn, before)
        self.assertNotIn("NaN", drawn)
        self.assertNotIn("Infinity", drawn)
        self.assert_quiet(page)

    def test_the_keyboard_is_enough(self):
        page = self.lion()
        tree = page.call("Accessibility.getFullAXTree")["nodes"]
        controls = {"checkbox", "slider", "combobox", "ComboBoxSelect", "button", "application", "image",
                    "link"}
        found = [node for node in tree
                 if not node.get("ignored") and node.get("role", {}).get("value") in controls]
        self.assertGreater(len(found), 25)
        unnamed = [node for node in found if not node.get("name", {}).get("value")]
        self.assertEqual(unnamed, [])
        order = []
        for _ in range(40):
            for kind in ("keyDown", "keyUp"):
                page.call("Input.dispatchKeyEvent", type=kind, key="Tab", code="Tab", windowsVirtualKeyCode=9)
            order.append(page.run("[document.activeElement].map((e) => e.id || e.className || e.tagName)[0]"))
        for wanted in ("show-0", "surface", "minima", "threshold", "direction", "view", "next-point",
                       "log", "copy"):
            self.assertIn(wanted, order)
        self.assertLess(order.index("show-0"), order.index("threshold"))
        self.assertLess(order.index("threshold"), order.index("view"))
        self.assertNotEqual(page.run("getComputedStyle(document.activeElement).outlineStyle"), "none")

        page.run("morsel.viewer.views[0].area.focus()")
        before = page.run(DRAWN)["hash"]
        seen = {before}
        for key in ("ArrowLeft", "ArrowUp", "+", "ArrowRight", "-"):
            page.press(key)
            seen.add(page.run(DRAWN)["hash"])
        self.assertEqual(len(seen), 6)
        page.press("0")
        self.assertEqual(page.run(DRAWN)["hash"], before)
        chosen = []
        for _ in range(2):
            page.press("n")
            chosen.append(page.run("morsel.state.selected.point"))
        ranking = page.run("[...morsel.page.methods[0].points.ranking.slice(0, 2)]")
        self.assertEqual(chosen, ranking)
        page.press("p")
        self.assertEqual(page.run("morsel.state.selected.point"), ranking[0])
        page.press("Escape")
        self.assertIsNone(page.run("morsel.state.selected"))
        self.assert_quiet(page)

    def test_a_phone_in_the_dark(self):
        page = self.lion(width=360, height=740, dark=True, phone=True)
        self.assertEqual(page.run("document.documentElement.scrollWidth"), 360)
        self.assertEqual(page.run("innerWidth"), 360)
        self.assertGreater(page.run(DRAWN)["covered"], 0.1)
        # one model at first, and it leaves room to scroll by
        self.assertEqual(page.run("morsel.viewer.views.filter((v) => !v.area.hidden).length"), 1)
        self.assertLess(page.run("document.getElementById('views-box').clientHeight"), 740 * 0.7)
        light = """(() => {  // contrasts of texts with the ground, as WCAG defines them
            const linear = (x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4);
            const light = (color) => { const [r, g, b] = color.match(/[\\d.]+/g).map((x) => linear(x / 255));
                return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
            const ground = light(getComputedStyle(document.documentElement).backgroundColor);
            return [...document.querySelectorAll(
                'h1, th, td, label, .hint, #subtitle, legend, dd, figcaption')]
              .map((e) => light(getComputedStyle(e).color))
              .map((text) => (Math.max(text, ground) + 0.05) / (Math.min(text, ground) + 0.05)); })()"""
        contrasts = page.run(light)
        self.assertGreater(min(contrasts), 4.5)
        ground = "getComputedStyle(document.documentElement).backgroundColor"
        dark = page.run(ground)
        page.prefer("light")
        self.assertNotEqual(page.run(ground), dark)
        self.assertEqual(page.run(ground), "rgb(255, 255, 255)")
        self.assertGreater(min(page.run(light)), 4.5)
        self.assert_quiet(page)

    def test_a_hostile_name_is_shown_as_it_is(self):
        (self.folder / "<").mkdir()
        name = "</script><img src=x onerror=alert(1)>.off"
        page = self.page(self.file(name, OCTAHEDRON), "--field", "height:axis=z", "--method", "conventional")
        self.assertEqual(page.run("document.getElementById('title').textContent"),
                         name.rsplit("/", maxsplit=1)[-1])
        self.assertEqual(page.run("document.images.length"), 0)
        self.assertIn(name, page.run("document.getElementById('command').textContent"))
        self.assertIn("6 vertices", page.run("document.getElementById('subtitle').textContent"))
        page.run(DRAWN)
        self.assert_quiet(page)

    def test_in_a_sandboxed_frame(self):
        """As a notebook shows it: all methods are shown, whichever is first, the layout or the scripts."""
        self.morsel("compare", self.file("o.off", OCTAHEDRON), "--field", "height:axis=z", "--method",
                    "conventional", "--method", "salient", "--html", "page.html")
        page = html.escape((self.folder / "page.html").read_text())
        frame = self.file("frame.html", "<body data-state=\"ready\"><p>A notebook</p>"
                          f'<iframe srcdoc="{page}" width="100%" height="700" style="border:0" '
                          'sandbox="allow-scripts allow-downloads"></iframe>')
        for _ in range(4):
            outer = self.browser.open(frame)
            inner = outer.frame()
            self.assertEqual(inner.state(), "ready")
            self.assertEqual(inner.run("morsel.state.shown"), [True, True])
            self.assertEqual(inner.run("document.getElementById('views-box').clientWidth > 860"), True)
            outer.close()

    def test_a_damaged_page_says_so(self):
        self.morsel("compare", self.file("o.off", OCTAHEDRON), "--field", "height:axis=z", "--html",
                    "page.html")
        text = (self.folder / "page.html").read_text()
        start = text.index('id="buffers">') + len('id="buffers">')
        broken = self.file("broken.html", text[:start] + text[start + 40:])
        page = self.browser.open(broken)
        self.addCleanup(page.close)
        self.assertEqual(page.run("document.body.dataset.state"), "failed")
        self.assertFalse(page.run("document.getElementById('problem').hidden"))


if __name__ == "__main__":
    unittest.main()
