"""The linker takes two types of the same name and namespace for one, and uses the functions of one of them for both. So
each room of the driver has its own namespace, and no type is defined twice. Types in anonymous namespaces, functions and
other types do not count."""
import collections
import re
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
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


class OneDefinition(unittest.TestCase):
    maxDiff = None

    def assert_one_each(self, places):
        self.assertEqual([(name, where) for name, where in places.items() if len(where) > 1], [])

    def test_types_are_found(self):
        code = 'namespace a { template <class T> class B final : public std::C<T> { struct D {}; }; namespace ' \
               '{ struct E {}; } enum class F : int { kG = \'{\' };  // struct H {\n} namespace a::b { struct B {}; }'
        self.assertEqual(list(types(code)), [("a", "B"), ("a", "F"), ("a::b", "B")])

    def test_no_type_is_defined_twice(self):
        places = collections.defaultdict(list)
        for source, namespace, name in types_in("aibo_driver", "aibo_rcserver", "test", "benchmark"):
            places[f"{namespace}::{name}"].append(str(source))
        self.assert_one_each(places)

    def test_each_room_of_the_driver_has_a_namespace_of_its_own(self):
        rooms = collections.defaultdict(set)
        for source, namespace, _ in types_in("aibo_driver"):
            rooms[namespace].add(source.parts[1])
        self.assert_one_each(rooms)


unittest.main()
