"""Man pages and completions: every command and option is in them, and the programs that read them accept
them."""

import os
import pathlib
import re
import shutil
import subprocess
import unittest

from support import ProgramTest

MANUAL = os.environ["MORSEL_MANUAL"]


class ManualTest(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.made = pathlib.Path(MANUAL)

    def options(self):
        """Each command with the names of its options."""
        found = {}
        for name in self.commands():
            headings = re.findall(r"^  (-.*?)(?:  |$)", self.morsel(name, "--help").stdout, re.MULTILINE)
            found[name] = set(re.findall(r"(?:^|, )(--?[a-z][a-z-]*)", "\n".join(headings), re.MULTILINE))
        return found

    def test_every_command_has_a_page_with_its_options(self):
        commands = self.options()
        self.assertEqual({path.name for path in (self.made / "man1").iterdir()},
                         {"morsel.1", *(f"morsel-{name}.1" for name in commands)})
        for name, options in commands.items():
            page = (self.made / "man1" / f"morsel-{name}.1").read_text().replace("\\-", "-")
            for option in options:
                self.assertIn(f"\\fB{option}\\fR", page, name)

    def test_pages_are_shown_without_a_warning(self):
        if not shutil.which("groff"):
            self.skipTest("groff is not installed")
        for page in sorted((self.made / "man1").iterdir()):
            result = subprocess.run(["groff", "-man", "-ww", "-K", "utf-8", "-T", "utf8", page],
                                    capture_output=True,
                                    text=True, check=False)
            self.assertEqual((result.returncode, result.stderr), (0, ""), page)
            self.assertIn("EXIT STATUS", re.sub(r"\x1b\[[0-9;]*m|.\x08", "", result.stdout))

    def complete(self, *words):
        """What bash offers for the last of the words."""
        script = ('source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _morsel; '
                  "printf '%s\\n' \"${COMPREPLY[@]}\"")
        result = subprocess.run(["bash", "-uc", script, "bash", self.made / "bash/morsel", *words],
                                capture_output=True,
                                text=True, check=True, cwd=self.folder)
        self.assertEqual(result.stderr, "")
        return set(result.stdout.split())

    def test_bash_completes(self):
        self.file("scan.off", "")
        self.assertEqual(self.complete("morsel", "co"), {"compare"})
        self.assertIn("scan.off", self.complete("morsel", "sc"))
        self.assertEqual(self.complete("morsel", "help", "quad"), {"quads"})
        self.assertEqual(self.complete("morsel", "compare", "scan.off", "--fi"),
                         {"--field", "--figures", "--fill"})
        self.assertEqual(self.complete("morsel", "compare", "scan.off", "--method", "tp"), {"tps"})
        self.assertEqual(self.complete("morsel", "compare", "scan.off", "--up", ""), {"x", "y", "z"})
        self.assertEqual(self.complete("morsel", "field", "scan.off", "-o", "s"), {"scan.off"})
        self.assertEqual(self.complete("morsel", "methods", "sali"), {"salient", "saliency"})
        for name, options in self.options().items():
            self.assertLessEqual(options, self.complete("morsel", name, "-") | {"-o"}, name)

    def test_zsh_and_fish_have_every_option(self):
        for shell, file in (("zsh", "zsh/_morsel"), ("fish", "fish/morsel.fish")):
            text = (self.made / file).read_text()
            for name, options in self.options().items():
                for option in options - {"-o", "-h"}:
                    self.assertIn(option if shell == "zsh" else f"-l {option[2:]}", text, (shell, name))

    def test_every_description_is_a_whole_text(self):
        """None is empty, cut within a parenthesis or begins with the extension of a file."""
        found = []
        for file, pattern in (("zsh/_morsel", r"'\*?--?[a-z][a-z-]*\[(.*?)(?<!\\)\]"),
                              ("zsh/_morsel", r"^    '[a-z]+:(.*)'$"),
                              ("fish/morsel.fish", r" -d '(.*)'$")):
            texts = re.findall(pattern, (self.made / file).read_text(), re.MULTILINE)
            self.assertGreater(len(texts), 10, pattern)
            found += texts
        for text in found:
            self.assertRegex(text, r"^[A-Za-z]", text)
            self.assertEqual(text, text.strip())
            self.assertEqual(text.count("("), text.count(")"), text)
        self.assertIn("Take a picture of a surface coloured by a field or its segments, with critical points "
                      "and arcs", found)
        self.assertIn("The file to write", found)

    def check_completion(self, shell, offered):
        """`offered` is what the shell offers for a line."""
        if not shutil.which(shell):
            self.skipTest(f"{shell} is not installed")
        self.file("scan.off", "")
        for line, words in (("morsel comp", {"compare"}), ("morsel sc", {"scan.off"}),
                            ("morsel help qu", {"quads"}), ("morsel compare --me", {"--method"}),
                            ("morsel compare scan.off --method tp", {"tps"}),
                            ("morsel scan.off --method tp", {"tps"}),
                            ("morsel compare scan.off --up ", {"x", "y", "z"}),
                            ("morsel compare sc", {"scan.off"}),
                            ("morsel field scan.off -o sc", {"scan.off"}),
                            ("morsel methods sali", {"salient", "saliency"}),
                            ("morsel cut compare --no-s", {"--no-shorten"}),
                            ("morsel render scan.off --ar", {"--arcs"})):
            with self.subTest(line):
                self.assertEqual(offered(line), words)

    def lines(self, *command):
        """What the command prints; the shells keep their files in the test's folder."""
        homes = dict.fromkeys(("HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME"), str(self.folder / "home"))
        result = subprocess.run([*map(str, command)], cwd=self.folder, env={**os.environ, **homes},
                                capture_output=True, text=True, check=True, timeout=60)
        return result.stdout.splitlines()

    def test_zsh_completes(self):
        script = pathlib.Path(__file__).with_name("complete.zsh")
        self.check_completion("zsh", lambda line: {
            word.strip() for word in self.lines("zsh", "-f", script, self.made / "zsh", line)})

    def test_fish_completes(self):
        self.check_completion("fish", lambda line: {word.split("\t")[0] for word in self.lines(
            "fish", "-c", "source $argv[1]; complete -C $argv[2]", self.made / "fish/morsel.fish", line)})


if __name__ == "__main__":
    unittest.main()
