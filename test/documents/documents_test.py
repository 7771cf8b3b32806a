"""docs/security.md names tests for each attack: FILE:SUITE. Every one of them exists. Links between documents lead
somewhere. docs/first_start.md fits on one sheet of paper. The Debian packages have everything that is installed.
Scripts that the tests do not run build what there is to build."""
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
    """What is wrong with FILE and SUITE; None if there are such tests."""
    file, suite = reference
    files = sorted((PROJECT / "test").rglob(file))
    if not files:
        return f"there is no file {file} below test/"
    if not any(re.search(rf"\b{suite}\b", path.read_text(encoding="utf-8")) for path in files):
        return f"{file} has no tests {suite}"
    return None


class SecurityTest(unittest.TestCase):
    attacks = rows((PROJECT / "docs/security.md").read_text(encoding="utf-8"), "## Attacks")

    def test_every_attack_has_tests_that_exist(self):
        self.assertGreater(len(self.attacks), 30)
        for row in self.attacks:
            with self.subTest(attack=row[0]):
                self.assertEqual(len(row), 3, row)
                references = REFERENCE.findall(row[2])
                self.assertTrue(references, f"no FILE:SUITE in '{row[2]}'")
                self.assertEqual(", ".join(f"`{file}:{suite}`" for file, suite in references), row[2])
                self.assertEqual([p for p in map(problem, references) if p], [])


def links_in(text):
    """The targets of links and pictures, without those in examples of code."""
    text = re.sub(r'^```.*?^```', '', text, flags=re.MULTILINE | re.DOTALL)
    return re.findall(r'\]\(([^)\s]+)\)', re.sub(r'`[^`\n]*`', '', text))


def anchors_in(text):
    """The anchors that GitHub makes of headings."""
    text = re.sub(r'^```.*?^```', '', text, flags=re.MULTILINE | re.DOTALL)
    headings = re.findall(r'^#+ (.+)$', text, flags=re.MULTILINE)
    texts = [re.sub(r'\[([^]]*)\]\([^)]*\)', r'\1', heading) for heading in headings]
    return {re.sub(r'[^\w\- ]', '', text).strip().lower().replace(' ', '-') for text in texts}


def broken_links(document, text):
    """What is wrong with the links in the text of a document."""
    problems = []
    for link in links_in(text):
        path, _, anchor = link.partition('#')
        target = (document.parent / path).resolve() if path else document
        if re.match(r'\w+:', link):
            continue
        if not target.exists():
            problems.append(f'{link}: there is no such file')
        elif anchor and anchor not in anchors_in(target.read_text(encoding='utf-8')):
            problems.append(f'{link}: there is no such heading')
    return problems


class LinksTest(unittest.TestCase):
    documents = [path for folder in ('.', 'docs', 'aibo_driver', 'aibo_rcserver', 'test', 'benchmark')
                 for path in sorted((PROJECT / folder).glob('*.md'))]

    def test_lead_somewhere(self):
        self.assertGreater(len(self.documents), 20)
        for document in self.documents:
            with self.subTest(document=document.name):
                self.assertEqual(broken_links(document, document.read_text(encoding='utf-8')), [])

    def test_the_index_has_every_page_and_each_picture_is_shown(self):
        folder = PROJECT / 'docs'
        index = set(links_in((folder / 'README.md').read_text(encoding='utf-8')))
        self.assertEqual({path.name for path in folder.glob('*.md')} - index, {'README.md'})
        shown = {(document.parent / link).resolve() for document in self.documents
                 for link in links_in(document.read_text(encoding='utf-8'))}
        self.assertEqual([path.name for path in sorted((folder / 'images').iterdir())
                          if path.suffix != '.dot' and path not in shown], [])


class PackagesTest(unittest.TestCase):
    """What CMake installs, and what debian/*.install puts into packages."""

    @staticmethod
    def installed():
        """The paths that CMake installs, such as usr/lib/aibo_driver/aibo_room. Folders stand for their content."""
        command = re.compile(r'file\(INSTALL DESTINATION "\$\{CMAKE_INSTALL_PREFIX\}/([^"]*)" TYPE \w+'
                             r'(?: RENAME "([^"]*)")?[^"\n]*? FILES((?:\s+"[^"]*")+)')
        build = Path(os.environ["BUILD_FOLDER"])
        paths = set()
        for script in [build / "cmake_install.cmake", *build.glob("aibo_*/**/cmake_install.cmake")]:
            for folder, name, files in command.findall(script.read_text("utf-8")):
                paths.update(f"usr/{folder}/{name or Path(file).name}" for file in re.findall(r'"([^"]*)"', files))
        return paths - {"usr/lib/aibo_driver/aibo"}  # a link instead

    @staticmethod
    def packaged():
        """The patterns in debian/*.install. Packages have a folder lib/ARCHITECTURE, CMake has not."""
        return {line.split()[0].replace("usr/lib/*/", "usr/lib/") for file in (PROJECT / "debian").glob("*.install")
                for line in file.read_text("utf-8").splitlines()}

    @staticmethod
    def contains(pattern, path):
        return any(fnmatch.fnmatch(str(each), pattern) for each in [Path(path), *Path(path).parents])

    def test_have_everything_that_is_installed(self):
        installed = self.installed()
        for part in ("bin/aibo", "lib/aibo_driver/aibo_room", "share/aibo_driver/launch", "share/aibo_driver/msg/Leds.msg",
                     "share/aibo_driver/srv/Say.srv", "share/bash-completion/completions/aibo"):
            self.assertIn(f"usr/{part}", installed)
        packaged = self.packaged()
        self.assertEqual([path for path in sorted(installed)
                          if not any(self.contains(pattern, path) for pattern in packaged)], [])

    def test_name_nothing_that_is_not_installed(self):
        installed = self.installed()
        made = {"usr/lib/cmake/aibo_driver", "usr/share/man"}  # in a build for a package only
        self.assertEqual([pattern for pattern in sorted(self.packaged() - made) if not any(
            self.contains(pattern, path) or path.startswith(f"{pattern}/") for path in installed)], [])

    def test_have_a_manual_page_for_each_command(self):
        links = (PROJECT / "debian/aibo-rcserver.links").read_text("utf-8")
        pages = re.findall(r"call manual,([a-z_]+),", (PROJECT / "debian/rules").read_text("utf-8"))
        commands = re.findall(r"usr/bin/(\w+)$", links, re.MULTILINE)
        commands += [Path(path).name for path in self.installed() if path.startswith("usr/bin/")]
        self.assertGreater(len(commands), 2)
        self.assertEqual(sorted(commands), sorted(pages))


class RosdepTest(unittest.TestCase):
    """On Ubuntu 20.04, rosdep installs what package.xml names."""

    KEYS = {"Boost": "libboost-program-options-dev", "Eigen3": "eigen", "JPEG": "libjpeg", "ZLIB": "zlib",
            "sndfile": "libsndfile1-dev", "samplerate": "libsamplerate0-dev"}  # others have the name that CMake knows

    def test_installs_what_the_build_requires(self):
        cmake = "".join((PROJECT / folder / "CMakeLists.txt").read_text("utf-8") for folder in (".", "aibo_driver/walk"))
        components = re.search(r"find_package\(catkin REQUIRED COMPONENTS([^)]*)\)", cmake)[1].split()
        required = components + re.findall(r"find_package\((\w+) REQUIRED", cmake) + re.findall(
            r"pkg_check_modules\(\w+ REQUIRED IMPORTED_TARGET ([\w-]+)\)", cmake)
        named = re.findall(r"<(?:buildtool_|build_)?depend>([\w-]+)<", (PROJECT / "package.xml").read_text("utf-8"))
        self.assertEqual(set(self.KEYS.get(each, each) for each in required) - {"PkgConfig", "Threads"} - set(named),
                         set())


class ScriptsTest(unittest.TestCase):
    @unittest.skipUnless((Path(os.environ["BUILD_FOLDER"]) / "build.ninja").exists(), "needs a build with ninja")
    def test_build_targets_that_exist(self):
        ninja = subprocess.run(["ninja", "-C", os.environ["BUILD_FOLDER"], "-t", "targets", "all"],
                               stdout=subprocess.PIPE, universal_newlines=True, check=True)
        targets = set(re.findall(r"^([^:\s]+): ", ninja.stdout, re.MULTILINE))
        built = []
        for script in filter(Path.is_file, sorted((PROJECT / "scripts").iterdir())):
            text = script.read_text("utf-8").replace("\\\n", " ")
            for arguments in re.findall(r'"\$project_dir/scripts/build" (?:--sanitize \S+ |--\w+ )*([^$\n]*)', text):
                built += [(script.name, word) for word in arguments.split() if re.fullmatch(r"\w{2,}", word)]
        self.assertGreater(len(built), 20)
        optional = {"benchmarks", "aibo_walk_bench"}  # need packages that not every system has
        self.assertEqual([(script, word) for script, word in built if word not in targets | optional], [])


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
