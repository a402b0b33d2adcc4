"""morsel batch: the page of a collection in a browser."""

import unittest

from browser import Browser
from test_batch import BatchTest


class CollectionPage(BatchTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        super().setUp()
        self.file("meshes/<b>bad & \"wrong\".off", "OFF\n")
        self.batch("--html", code=1, pictures=True)

    def page(self, **settings):
        page = self.browser.open(self.out / "index.html", **settings)
        self.addCleanup(page.close)
        return page

    def rows(self, page):  # of the page, not of the table
        return page.run("[...document.querySelectorAll('tbody tr')].filter(row => !row.hidden)"
                        ".map(row => row.cells[0].dataset.v)")

    bad = "<b>bad & \"wrong\".off"

    def test_columns_sort(self):
        page = self.page()
        self.assertEqual(self.rows(page), [self.bad, *self.names])
        by_size = ["octahedron.off", "sphere.off", "deeper/an anchor.off"]
        sort = ("[...document.querySelectorAll('thead button')]"
                ".find(b => b.textContent === 'vertices').click()")
        page.run(sort)
        self.assertEqual(self.rows(page), [*by_size, self.bad])
        page.run(sort)
        self.assertEqual(self.rows(page), [*by_size[::-1], self.bad])
        self.assertEqual(page.run("document.querySelector('[aria-sort]').getAttribute('aria-sort')"),
                         "descending")
        self.assertEqual(page.said(), [])

    def test_meshes_are_found(self):
        page = self.page()
        for wanted, expected, said in (("FAILED", [self.bad], "1 of 4"), ("anchor", self.names[:1], "1 of 4"),
                                       ("nowhere", [], "0 of 4"), ("", [self.bad, *self.names], "")):
            page.run(f"document.getElementById('find').value = '{wanted}';"
                     "document.getElementById('find').dispatchEvent(new Event('input'));"
                     "new Promise(done => setTimeout(done, 300))")
            self.assertEqual(self.rows(page), expected)
            self.assertEqual(page.run("document.getElementById('found').textContent"), said)

    def test_of_very_many_rows_the_first_are_shown(self):
        page = self.page()
        page.run("limit = 2; show()")
        self.assertEqual(self.rows(page), [self.bad, self.names[0]])
        self.assertIn("first 2", page.run("found.textContent"))
        page.run("all.click()")
        self.assertEqual(self.rows(page), [self.bad, *self.names])
        self.assertTrue(page.run("all.hidden && found.textContent === ''"))

    def test_it_is_whole_on_a_phone_and_in_the_dark(self):
        for settings in ({"width": 390, "height": 800, "phone": True}, {"dark": True}, {}):
            page = self.page(**settings)
            self.assertLessEqual(page.run("document.documentElement.scrollWidth - window.innerWidth"), 0)
            self.assertEqual(page.run("Promise.all([...document.images].map(image => {"
                                      " image.loading = 'eager'; return image.decode(); }))"
                                      ".then(all => all.length)"), 3 + 2 * 3)
            self.assertEqual(page.said(), [])
            self.assertEqual([url for url in page.requests() if not url.startswith(("file:", "data:"))], [])


if __name__ == "__main__":
    unittest.main()
