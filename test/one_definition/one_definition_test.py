"""The linker takes two types of the same name and namespace for one, and uses the functions of one of them for both. So
each room of the driver has its own namespace, and no type is defined twice, neither in the sources nor as a message. Types
in anonymous namespaces and functions do not count. File systems that ignore case take Leds.h and leds.h for one."""
import collections
import re
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
INCLUDE_FOLDERS = ("aibo_driver/client/include", "aibo_driver", "aibo_rcserver", "test")
NOT_CODE = re.compile(r'''//[^\n]* | /\*.*?\*/ | R"(\w*)\(.*?\)\1" | "(?:\\.|[^"\\\n])*" | (?<!\w)'(?:\\.|[^'\\\n])*'
                          | ^[ ]*\#(?:\\\n|[^\n])* ''', re.DOTALL | re.MULTILINE | re.VERBOSE)
TEMPLATE = re.compile(r'template\s*<(?:[^<>]|<[^<>]*>)*>')
NAMESPACE = re.compile(r'\bnamespace\s+([\w:]+)$')
TYPE = re.compile(r'(?:^|\s)(?:class|struct|union|enum|enum\s+class)\s+(\w+)(?:\s+final)?(?:\s*:[^:].*)?$', re.DOTALL)


def types(code, source=None):
    """All types that are defined in a named namespace, or in none: pairs of namespace and type."""
    code = TEMPLATE.sub("", NOT_CODE.sub(" ", code))
    assert code.count("{") == code.count("}"), f"{source}: the braces do not balance, all branches of #if together"
    scopes = [""]  # one for each open brace: the namespace, or None inside anything else
    for before, end in re.findall(r'([^{};]*)([{};])', code):
        if end == "}":
            scopes.pop()
        elif end == "{":
            outer, inner, before = scopes[-1], None, before.strip()
            if outer is not None and (name := NAMESPACE.search(before)):
                inner = f"{outer}::{name[1]}" if outer else name[1]
            elif outer is not None and (name := TYPE.search(before)):
                yield outer, name[1]
            scopes.append(outer if before.startswith("extern") else inner)


def types_in(*folders):
    for source in sorted(f for folder in folders for f in (PROJECT / folder).rglob("*")):
        if source.suffix in (".h", ".cpp", ".cc"):
            for namespace, name in types(source.read_text(encoding="utf-8"), source):
                yield source.relative_to(PROJECT), namespace, name


def messages():
    """The types of aibo_msgs, each a pair of its source and its name in the namespace aibo_driver."""
    endings = {".msg": ("",), ".srv": ("", "Request", "Response"),
               ".action": [a + b for a in ("", "Action") for b in ("Goal", "Result", "Feedback")] + ["Action"]}
    for source in sorted((PROJECT / "aibo_msgs").rglob("*.*")):
        for ending in endings.get(source.suffix, ()):
            yield source.relative_to(PROJECT), source.stem + ending


class OneDefinition(unittest.TestCase):
    maxDiff = None

    def assert_one_each(self, places):
        self.assertEqual([(name, where) for name, where in places.items() if len(where) > 1], [])

    def test_no_type_is_defined_twice(self):
        places = collections.defaultdict(list)
        for source, namespace, name in types_in("aibo_driver", "aibo_rcserver", "test", "benchmark"):
            places[f"{namespace}::{name}"].append(str(source))
        for source, name in messages():
            places[f"aibo_driver::{name}"].append(str(source))
        self.assertIn("aibo_driver::Leds", places)
        self.assert_one_each(places)

    def test_no_two_headers_differ_in_case_alone(self):
        places = collections.defaultdict(list)
        for folder in INCLUDE_FOLDERS:
            for header in (PROJECT / folder).rglob("*.h"):
                places[str(header.relative_to(PROJECT / folder)).lower()].append(str(header))
        for source, name in messages():
            places[f"aibo_driver/{name}.h".lower()].append(str(source))
        self.assert_one_each(places)

    def test_each_room_of_the_driver_has_a_namespace_of_its_own(self):
        rooms = collections.defaultdict(set)
        for source, namespace, _ in types_in("aibo_driver"):
            rooms[namespace].add(source.parts[1])
        self.assert_one_each(rooms)


unittest.main()
