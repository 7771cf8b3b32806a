"""GNU ld instead of the SDK's, with mkbin's calls. Today's ld cannot do two of mkbin's four steps:

- `ld -r` gives gensnap the relocations, but lays out the sections differently from the program, so gensnap would
  relocate the wrong words. Here they come from the program itself (--emit-relocs).
- `ld -T ldscript-merge` moves the program to address 0 and adds gensnap's tables. Today's ld refuses finished programs,
  and makes room for more headers, which moves everything but gensnap's addresses. The form here is that of Sony's
  samples: sections by address from 0, then a segment with gensnap's header, then gensnap's other tables, without a
  segment.
"""
import io
import os
import struct
import sys
from pathlib import Path

from elftools.elf.elffile import ELFFile

from .binary import relocation_tables

LD = "mipsel-linux-gnu-ld"
LINKED_AT = 0x400000   # where GNU ld puts programs; gensnap subtracts it, too
TABLES_AT = 0xf0000000  # the address of gensnap's tables in Sony's ldscript-snap
PAGE = 0x1000

EHDR = "<16sHHIIIIIHHHHHH"
PHDR = "<8I"
SHDR = "<10I"
NOBITS = 8
ALLOC = 2

# The flags of Sony's samples: MIPS I, the ABI o32, noreorder, and code that finds its data by gp (CPIC). GNU ld 2.15
# would also keep PIC, which GCC 12 sets in its object files.
FLAGS = 0x1005

TABLES = (".ObletDependencyDescr", ".ObletDependencyDescrList", ".RelEntry", ".RelDataEntry")


def relocations_by_section(program):
    """The program, with each relocation's offset from the beginning of its section, as in object files."""
    elf = ELFFile(io.BytesIO(program))
    changed = bytearray(program)
    for table in relocation_tables(elf):
        base = elf.get_section(table["sh_info"])["sh_addr"]
        for place in range(table["sh_offset"], table["sh_offset"] + table["sh_size"], table["sh_entsize"]):
            offset, = struct.unpack_from("<I", changed, place)
            struct.pack_into("<I", changed, place, offset - base)
    return bytes(changed)


class _Writer:
    """Collects sections and their contents."""

    def __init__(self):
        self.image = bytearray()
        self.headers = [(0,) * 10]
        self.names = bytearray(b"\0")

    def align(self, step):
        self.image.extend(bytes(-len(self.image) % step))

    def add(self, name, kind, flags, address, data, size=None, alignment=1, entry_size=0, offset=None):
        """Adds a section. Its data goes to the end unless `offset` is given."""
        if offset is None:
            offset = len(self.image)
            self.image.extend(data)
        self.headers.append((len(self.names), kind, flags, address, offset, len(data) if size is None else size, 0, 0,
                             alignment, entry_size))
        self.names.extend(name.encode() + b"\0")


def merge(program, tables):
    """The bytes of the finished program. `tables` are gensnap's, linked with ldscript-snap."""
    program, tables = (ELFFile(io.BytesIO(data)) for data in (program, tables))
    loaded = [section for section in program.iter_sections()
              if section["sh_flags"] & ALLOC and section["sh_type"] != "SHT_REL"]
    end = max(section["sh_addr"] + section["sh_size"] for section in loaded) - LINKED_AT
    writer = _Writer()
    for section in loaded:  # their offsets are their addresses
        if section["sh_type"] != "SHT_NOBITS":
            writer.image.extend(bytes(section["sh_addr"] - LINKED_AT - len(writer.image)))
            writer.image.extend(section.data())
    file_size = len(writer.image)
    writer.align(PAGE)
    header_at = len(writer.image)
    header = tables.get_section_by_name(".SnapShotHdr")
    writer.add(".SnapShotHdr", 1, header["sh_flags"], TABLES_AT, header.data(), alignment=16)
    writer.align(PAGE)
    rest_at = len(writer.image)
    for name in TABLES:
        section = tables.get_section_by_name(name)
        data = section.data() if section is not None else b""
        writer.align(4)
        writer.add(name, 1, 0, TABLES_AT, data, alignment=4)
    dummy = tables.get_section_by_name(".Dummy")
    dummy_size = dummy["sh_size"] if dummy is not None else 0
    writer.add(".Dummy", NOBITS, 7, TABLES_AT, b"", dummy_size, 16, offset=rest_at)
    writer.add(".SingleSegment", 1, 1, TABLES_AT, bytes(4))
    for section in loaded:
        fields = section.header
        writer.add(section.name, _number(section), fields["sh_flags"], fields["sh_addr"] - LINKED_AT, b"",
                   fields["sh_size"], fields["sh_addralign"], fields["sh_entsize"],
                   min(fields["sh_addr"] - LINKED_AT, file_size))
    return _finish(writer, program, file_size, end, header_at, header["sh_size"], rest_at + dummy_size - header_at)


def _number(section):
    return {"SHT_PROGBITS": 1, "SHT_NOBITS": NOBITS, "SHT_MIPS_REGINFO": 0x70000006}[section["sh_type"]]


def _finish(writer, program, file_size, end, header_at, header_size, header_memory):
    reginfo = program.get_section_by_name(".reginfo")
    reginfo_at = reginfo["sh_addr"] - LINKED_AT
    text = program.get_section_by_name(".text")
    writer.add(".shstrtab", 3, 0, 0, bytes(writer.names) + b".shstrtab\0")
    writer.align(4)
    section_headers_at = len(writer.image)
    for fields in writer.headers:
        writer.image.extend(struct.pack(SHDR, *fields))
    segments = ((0x70000000, reginfo_at, reginfo_at, reginfo_at, reginfo["sh_size"], reginfo["sh_size"], 4, 4),
                (1, 0, 0, 0, file_size, end, 7, PAGE),
                (1, header_at, TABLES_AT, TABLES_AT, header_size, header_memory, 7, PAGE))
    ident = b"\x7fELF\1\1\1" + bytes(9)
    struct.pack_into(EHDR, writer.image, 0, ident, 2, 8, 1, text["sh_addr"] - LINKED_AT, 52, section_headers_at, FLAGS,
                     52, 32, len(segments), 40, len(writer.headers), len(writer.headers) - 1)
    for number, segment in enumerate(segments):
        struct.pack_into(PHDR, writer.image, 52 + 32 * number, *segment)
    return bytes(writer.image)


def main(arguments):
    output = Path(arguments[arguments.index("-o") + 1])
    scripts = [Path(arguments[i + 1]).name for i, word in enumerate(arguments) if word == "-T"]
    if "-r" in arguments:
        program = output.with_name(output.name.replace(".rel.elf", ".nosnap.elf"))
        output.write_bytes(relocations_by_section(program.read_bytes()))
    elif scripts == ["ldscript-merge"]:
        program, tables = arguments[-2:]
        output.write_bytes(merge(Path(program).read_bytes(), Path(tables).read_bytes()))
    else:
        os.execvp(LD, [LD, "-EL", "--emit-relocs", "--no-warn-rwx-segments", *arguments])


if __name__ == "__main__":
    main(sys.argv[1:])
