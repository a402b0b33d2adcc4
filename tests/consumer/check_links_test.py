#!/usr/bin/env python3
"""check_links.py finds links that lead nowhere, and no others."""

import pathlib
import tempfile
import unittest

import check_links

README = """# A title
[a page](docs/page.md) [a part](docs/page.md#the-second-part-a-b) [a picture](tools/a.png)
[web](https://a.b/c)
```
[no link](nowhere)
```
"""
PAGE = "# Page\n## The second part: `A`, B\n[up](../README.md#a-title) [here](#page)\n"


class Links(unittest.TestCase):
    def broken(self, readme=README, page=PAGE):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for path, text in {"README.md": readme, "docs/page.md": page, "tools/a.png": ""}.items():
                (folder / path).parent.mkdir(exist_ok=True)
                (folder / path).write_text(text)
            return [link for _, link in check_links.broken_links(folder)]

    def test_whole_pages_have_none(self):
        self.assertEqual(self.broken(), [])

    def test_a_missing_file_and_a_missing_heading_are_found(self):
        self.assertEqual(self.broken(readme=README + "[x](docs/gone.md) ![x](b.png) [x](docs/page.md#gone)"),
                         ["docs/gone.md", "b.png", "docs/page.md#gone"])
        self.assertEqual(self.broken(page=PAGE + "[x](#the-first-part)"), ["#the-first-part"])


if __name__ == "__main__":
    unittest.main()
