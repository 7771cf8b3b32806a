"""Checks a finished OPEN-R program of any compiler: can the robot's loader place it, and does its code then find its
data?

The loader puts the program at some address, and adds the difference to the words that .RelDataEntry names. Everything
else must be independent of the address. The SDK's gensnap and the programs among Sony's samples show what is expected.
"""
import io
import struct
from array import array

try:
    from elftools.common.exceptions import ELFError
    from elftools.elf.elffile import ELFFile
except ImportError:  # missing_pyelftools() of stick.sdk gives advice
    pass

LINKED_AT = 0x400000  # GNU ld's address for programs; their words still have it
TABLES_AT = 0xf0000000
GP_OFFSET = 0x7ff0    # distance of the register gp from the beginning of .got (MIPS ABI)
MODULE_POINTER = 0x80000000  # GNU's mark in the second word of .got
GP = 28
MAX_WORDS_NAMED = 3
SMALL_FRAME = 4096  # bytes; some functions of newlib need it, even in Sony's programs with a stack of 3 KB

# The frame of newlib's __sbprintf, which prints to unbuffered streams such as stderr. All programs have it.
UNBUFFERED_PRINTF = range(16384, 16640)

NEEDED = (".SnapShotHdr", ".ObletDependencyDescr", ".ObletDependencyDescrList", ".RelEntry", ".RelDataEntry",
          ".reginfo", ".text", ".ctors", ".got")

# gensnap adapts R_MIPS_32. It leaves out the other relocations, which do not depend on the program's address.
RELOCATIONS = {0: "R_MIPS_NONE", 2: "R_MIPS_32", 5: "R_MIPS_HI16", 6: "R_MIPS_LO16", 9: "R_MIPS_GOT16",
               11: "R_MIPS_CALL16", 12: "R_MIPS_GPREL32", 248: "R_MIPS_PC32"}


# Debian 11's iter_sections() and iter_segments() cannot choose a type.
def relocation_tables(elf):
    return (section for section in elf.iter_sections() if section["sh_type"] == "SHT_REL")


class Broken(Exception):
    """The program is too damaged for further checks."""


class Program:
    """One program. problems() yields a text for each fault, and fills in what is unusual: Sony's tools accept it, and
    other people's programs have it."""

    def __init__(self, data, linked=None, relocations=None):
        """`linked` is mkbin's NAME.nosnap.elf, `relocations` its NAME.rel.elf: their bytes, or None."""
        self._data = data
        self._linked = linked
        self._relocations = relocations
        self._sections = {}
        self.unusual = []

    def problems(self):
        try:
            self._elf = ELFFile(io.BytesIO(self._data))
            self._sections = {section.name: section for section in self._elf.iter_sections() if section.name}
            yield from self._form()
            yield from self._tables()
            yield from self._words()
            yield from self._constructors()
            yield from self._code()
            if self._linked is not None:
                yield from self._same_as_linked()
            if self._relocations is not None:
                yield from self._kinds_of_relocations()
        except (ELFError, struct.error) as error:
            yield f"it is not a whole ELF file: {error}"
        except Broken as broken:
            yield str(broken)

    def _form(self):
        header = self._elf.header
        if (self._elf.elfclass, self._elf.little_endian, header["e_machine"], header["e_type"]) != (
                32, True, "EM_MIPS", "ET_EXEC"):
            raise Broken("it is not a program for the robot, a 32-bit little-endian MIPS ELF file")
        missing = [name for name in NEEDED if name not in self._sections]
        if missing:
            raise Broken(f"it has no section {', '.join(missing)}: mkbin was not run to its end")
        flags = header["e_flags"]
        if flags & ~0x3 == 0x0004:  # some compilers leave the ABI out
            self.unusual.append(f"its flags are {flags:#x}, which do not name the ABI")
        elif flags & ~0x3 != 0x1004:  # except for noreorder and PIC: o32, MIPS I, CPIC
            yield (f"its flags are {flags:#x}; the loader is known to accept 0x1005: MIPS I, the ABI o32, and code "
                   "that finds its data by gp (CPIC)")
        loaded = [segment for segment in self._elf.iter_segments() if segment["p_type"] == "PT_LOAD"]
        segments = [(segment["p_offset"] if segment["p_vaddr"] == 0 else None, segment["p_vaddr"])
                    for segment in loaded]
        if segments != [(0, 0), (None, TABLES_AT)]:
            raise Broken(f"it must have two segments, one for the program at 0 and one for the header at "
                         f"{TABLES_AT:#x}")
        self._memory = loaded[0]["p_memsz"]
        for section in self._placed():
            if section["sh_type"] != "SHT_NOBITS" and section["sh_offset"] != section["sh_addr"]:
                yield (f"{section.name} is at {section['sh_offset']:#x} in the file, but at {section['sh_addr']:#x} "
                       "in memory")
            if section["sh_addr"] + section["sh_size"] > self._memory:
                yield f"{section.name} ends behind the program's segment"

    def _placed(self):
        return [section for section in self._sections.values()
                if section["sh_flags"] & 2 and section["sh_addr"] < TABLES_AT]

    def _tables(self):
        header = self._bytes(".SnapShotHdr")
        name, kind = header[:64].rstrip(b"\0"), struct.unpack_from("<I", header, 128)[0]
        space = header[132:196].rstrip(b"\0")
        self._stack, heap = struct.unpack_from("<2I", header, 196)
        if kind != 1 or space != b"mCOOP" or not name or self._stack == 0 or heap == 0:
            yield ".SnapShotHdr describes no OPEN-R object with a name, a stack and a heap"
        entry, = struct.unpack_from("<I", self._bytes(".RelEntry"), 24)
        text = self._sections[".text"]
        if not text["sh_addr"] <= entry < text["sh_addr"] + text["sh_size"]:
            yield f"the entry point {entry:#x} is outside of .text"
        count, = struct.unpack_from("<I", self._bytes(".RelEntry"), 36)
        if count * 16 != self._sections[".RelDataEntry"]["sh_size"]:
            yield f".RelEntry counts {count} relocated words, .RelDataEntry has another number"

    def _words(self):
        """Each word in .RelDataEntry must have the table's address, in a section with data."""
        places = [section for section in self._placed() if section["sh_type"] == "SHT_PROGBITS" and
                  section.name != ".text"]
        wrong = []
        self._relocated = {}
        for symbol, kind, offset, value in struct.iter_unpack("<4I", self._bytes(".RelDataEntry")):
            inside = any(s["sh_addr"] <= offset <= s["sh_addr"] + s["sh_size"] - 4 for s in places)
            if (symbol, kind) != (1, 2) or offset % 4 != 0 or offset in self._relocated or not inside:
                wrong.append(f"{offset:#x} is outside of all sections with data")
                continue
            self._relocated[offset] = value
            word, = struct.unpack_from("<I", self._data, offset)
            if word == MODULE_POINTER and offset == self._sections[".got"]["sh_addr"] + 4:
                continue
            # Addends may point a little behind the program, for instance to the end of .bss. Pages of .got begin before
            # it.
            if word not in ({value + LINKED_AT} if value else {0, LINKED_AT}) or value > self._memory + 0x10000:
                wrong.append(f"{offset:#x} holds {word:#x}, which is not {value:#x} of the table")
        yield from _some(wrong, ".RelDataEntry names words that are not addresses in this program")
        got = self._sections[".got"]
        left_out = [f"{at:#x}" for at in range(got["sh_addr"], got["sh_addr"] + got["sh_size"], 4)
                    if at not in self._relocated]
        yield from _some(left_out, ".RelDataEntry leaves out words of .got")

    def _constructors(self):
        """OPEN-R's InitGlobals() runs constructors from the last word but one down to -1."""
        text = self._sections[".text"]
        for name in (".ctors", ".dtors"):
            if name not in self._sections:
                continue
            table = self._sections[name]
            words = array("I", self._bytes(name))
            if len(words) < 2 or words[0] != 0xffffffff or words[-1] != 0:
                yield f"{name} does not begin with -1 and end with 0"
                continue
            places = range(table["sh_addr"] + 4, table["sh_addr"] + 4 * len(words) - 4, 4)
            wrong = [f"{word:#x}" for place, word in zip(places, words[1:-1]) if place not in self._relocated or
                     not text["sh_addr"] <= word - LINKED_AT < text["sh_addr"] + text["sh_size"]]
            yield from _some(wrong, f"{name} has words that are not relocated addresses of functions")

    def _code(self):
        start = self._sections[".text"]["sh_addr"]
        code = array("I", self._bytes(".text")[:self._sections[".text"]["sh_size"] // 4 * 4])
        gp = self._sections[".got"]["sh_addr"] + GP_OFFSET
        sets_gp, frame = False, 0
        wrong_gp, absolute, unknown = [], [], []
        for index, word in enumerate(code):
            operation, register = word >> 26, word >> 16 & 31
            if operation == 0x0f:  # lui
                if register == GP and code[index + 1] >> 16 == 0x279c and code[index + 2] == 0x0399e021:
                    sets_gp = True
                    function = start + 4 * index
                    if (function + ((word & 0xffff) << 16) + _signed(code[index + 1]) - gp) & 0xffffffff:
                        wrong_gp.append(f"{function:#x}")
                elif self._uses_address(code, index):
                    absolute.append(f"{start + 4 * index:#x}")
            elif operation in (2, 3) and word != 0:  # j, jal
                absolute.append(f"{start + 4 * index:#x}")
            elif operation in (0x1c, 0x1d, 0x1f):
                unknown.append(f"{start + 4 * index:#x}")
            elif word >> 16 == 0x27bd and word & 0x8000:  # addiu sp,sp,-N
                frame = max(frame, -_signed(word) if -_signed(word) not in UNBUFFERED_PRINTF else 0)
        yield from _some(wrong_gp, f"functions compute a gp other than {gp:#x}, so they would not find their data")
        yield from _some(absolute, "code uses addresses that the loader does not adapt")
        yield from _some(unknown, "code has instructions of newer processors than the robot's")
        if not sets_gp:
            yield "no function sets gp: this is not position-independent code"
        if frame > max(self._stack // 2, SMALL_FRAME):
            self.unusual.append(f"a function needs {frame} bytes of a stack of {self._stack}")

    def _uses_address(self, code, index):
        """True if this lui begins an address in the program that one of the next instructions completes."""
        register, high = code[index] >> 16 & 31, (code[index] & 0xffff) << 16
        for word in code[index + 1:index + 5]:
            operation, source, target = word >> 26, word >> 21 & 31, word >> 16 & 31
            if source == register and (operation == 9 or 0x20 <= operation <= 0x2e):
                return LINKED_AT <= high + _signed(word) < LINKED_AT + self._memory
            if operation >= 8 and target == register or operation == 0 and word >> 11 & 31 == register:
                return False
        return False

    def _same_as_linked(self):
        """The program must be the linked one, moved by exactly LINKED_AT, because gensnap's tables are for that one."""
        linked = {section.name: section for section in ELFFile(io.BytesIO(self._linked)).iter_sections()}
        for section in self._placed():
            other = linked.get(section.name)
            if other is None:
                yield f"the linked program has no {section.name}"
            elif other["sh_addr"] - section["sh_addr"] != LINKED_AT or other["sh_size"] != section["sh_size"]:
                yield (f"{section.name} is at {section['sh_addr']:#x}, {other['sh_addr'] - section['sh_addr']:#x} and "
                       f"not {LINKED_AT:#x} below its place in the linked program")
            elif section["sh_type"] == "SHT_PROGBITS" and section.data() != other.data():
                yield f"{section.name} differs from that of the linked program"

    def _kinds_of_relocations(self):
        elf = ELFFile(io.BytesIO(self._relocations))
        placed = {section.name: section for section in self._placed()}
        unknown, absolute, outside = set(), [], []
        for table in relocation_tables(elf):
            section = placed.get(table.name[len(".rel"):])
            if section is None:
                continue
            symbols = elf.get_section(table["sh_link"])
            for relocation in table.iter_relocations():
                kind = RELOCATIONS.get(relocation["r_info_type"])
                if kind is None:
                    unknown.add(f"number {relocation['r_info_type']}")
                if kind == "R_MIPS_HI16" and symbols.get_symbol(relocation["r_info_sym"]).name != "_gp_disp":
                    absolute.append(f"{section['sh_addr'] + relocation['r_offset']:#x}")
                if kind == "R_MIPS_32" and relocation["r_offset"] + 4 > section["sh_size"]:
                    outside.append(f"{relocation['r_offset']:#x} of {section.name}")
        yield from _some(sorted(unknown), "it was linked from relocations that gensnap does not know")
        yield from _some(absolute, "R_MIPS_HI16 belongs to a symbol other than _gp_disp")
        yield from _some(outside, "relocations are outside of their section")

    def _bytes(self, name):
        return self._sections[name].data()


def _signed(word):
    return (word & 0xffff) - ((word & 0x8000) << 1)


def _some(places, what):
    if places:
        more = f" and {len(places) - MAX_WORDS_NAMED} more" if len(places) > MAX_WORDS_NAMED else ""
        yield f"{what}: {', '.join(places[:MAX_WORDS_NAMED])}{more}"
