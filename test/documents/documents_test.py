"""docs/security.md names a test for each attack: FILE:NAME. Every one of them exists, and the test has not lost its
name. docs/first_start.md fits on one sheet of paper. Each program that is installed is in a Debian package."""
import fnmatch
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
REFERENCE = re.compile(r'`([\w.]+):(\w+)`')


def rows(document, heading):
    """The rows of the first table below a heading: lists of cells."""
    section = document.split(f"\n{heading}\n", 1)[1].split("\n## ", 1)[0]
    lines = [line for line in section.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split(" | ")] for line in lines[2:]]


def problem(reference):
    """What is wrong with FILE and NAME; None if there is such a test."""
    file, name = reference
    files = sorted((PROJECT / "test").rglob(file))
    if not files:
        return f"there is no file {file} below test/"
    if not any(re.search(rf"\b{name}\b", path.read_text(encoding="utf-8")) for path in files):
        return f"{file} has no test {name}"
    return None


class SecurityTest(unittest.TestCase):
    attacks = rows((PROJECT / "docs/security.md").read_text(encoding="utf-8"), "## Attacks")

    def test_every_attack_has_tests_that_exist(self):
        self.assertGreater(len(self.attacks), 30)
        for row in self.attacks:
            with self.subTest(attack=row[0]):
                self.assertEqual(len(row), 3, row)
                references = REFERENCE.findall(row[2])
                self.assertTrue(references, f"no FILE:NAME in '{row[2]}'")
                self.assertEqual(", ".join(f"`{file}:{name}`" for file, name in references), row[2])
                self.assertEqual([p for p in map(problem, references) if p], [])

    def test_a_test_that_does_not_exist_is_found(self):
        self.assertIn("no file", problem(("no_such_test.cpp", "Any")))
        self.assertIn("no test", problem(("settings_test.cpp", "EndLines")))
        self.assertIsNone(problem(("settings_test.cpp", "EndLinesAndComments")))


class PackagesTest(unittest.TestCase):
    def test_have_all_programs(self):
        installed = set()
        for script in Path(os.environ["BUILD_FOLDER"]).glob("aibo_*/**/cmake_install.cmake"):
            installed.update(re.findall(r'lib/aibo_driver" TYPE \w+ FILES "[^"]*/([^"/]+)"\)', script.read_text("utf-8")))
        self.assertGreater(len(installed), 10)
        packaged = [Path(line.split()[0]).name for file in sorted((PROJECT / "debian").glob("*.install"))
                    for line in file.read_text("utf-8").splitlines() if line.startswith("usr/lib/aibo_driver/")]
        self.assertEqual([program for program in sorted(installed - {"aibo"})
                          if not any(fnmatch.fnmatch(program, pattern) for pattern in packaged)], [])


class FirstStartSheetTest(unittest.TestCase):
    @unittest.skipIf(shutil.which("lowdown") is None or shutil.which("gropdf") is None,
                     "needs scripts/install_dependencies sheet")
    def test_fits_on_one_page(self):
        with tempfile.TemporaryDirectory() as folder:
            sheet = Path(folder) / "sheet.pdf"
            done = subprocess.run([str(PROJECT / "scripts/first_start_sheet"), str(sheet)], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, universal_newlines=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(sheet.read_bytes()[:5], b"%PDF-")


if __name__ == "__main__":
    unittest.main()
