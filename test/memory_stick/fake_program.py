"""Makes an OPEN-R program that no compiler has seen: the smallest one that the robot's loader could place, in the three
forms that mkbin has: linked (NAME.nosnap.elf), with gensnap's tables (NAME.snap.elf), and finished."""
import struct

PROGBITS, NOBITS, REL, SYMTAB, STRTAB, REGINFO = 1, 8, 9, 2, 3, 0x70000006
BASE = 0x400000
TABLES_AT = 0xf0000000

TEXT_AT, TEXT_SIZE = 0x4000b0, 0x50
RODATA_AT = 0x400100
RODATA_SIZE = 150_000
DATA_AT = RODATA_AT + RODATA_SIZE  # divisible by 16
CTORS_AT, DTORS_AT, GOT_AT = DATA_AT + 0x10, DATA_AT + 0x20, DATA_AT + 0x30
BSS_AT = GOT_AT + 0x10
GP = GOT_AT + 0x7ff0

R_MIPS_32, R_MIPS_HI16, R_MIPS_LO16 = 2, 5, 6


def set_gp(function, gp=GP):
    """The first three instructions of a function."""
    distance = gp - function & 0xffffffff
    high, low = (distance + 0x8000) >> 16 & 0xffff, distance & 0xffff
    return [0x3c1c0000 | high, 0x279c0000 | low, 0x0399e021]


def words(*values):
    return struct.pack(f"<{len(values)}I", *(value & 0xffffffff for value in values))


def code(*more):
    """.text: a function that sets gp, makes a frame of 32 bytes, and returns."""
    text = words(*set_gp(TEXT_AT), 0x27bdffe0, *more, 0x03e00008, 0x27bd0020)
    return text + bytes(TEXT_SIZE - len(text))


def sections(text=None, data=None, ctors=None, got=None, dtors=None):
    """The sections of a linked program: name, kind, flags, address, contents or size."""
    return [
        (".reginfo", REGINFO, 2, 0x400094, bytes(24)),
        (".text", PROGBITS, 6, TEXT_AT, code() if text is None else text),
        (".rodata", PROGBITS, 2, RODATA_AT, bytes(RODATA_SIZE)),
        (".data", PROGBITS, 3, DATA_AT, words(RODATA_AT, 7, 0, TEXT_AT) if data is None else data),
        (".ctors", PROGBITS, 3, CTORS_AT, words(-1, TEXT_AT, 0) if ctors is None else ctors),
        (".dtors", PROGBITS, 3, DTORS_AT, words(-1, 0) if dtors is None else dtors),
        (".got", PROGBITS, 0x10000003, GOT_AT, words(0, 0x80000000, DATA_AT, 0) if got is None else got),
        (".bss", NOBITS, 3, BSS_AT, 0x100),
    ]


RELOCATED = (DATA_AT, DATA_AT + 12, CTORS_AT + 4, GOT_AT, GOT_AT + 4, GOT_AT + 8, GOT_AT + 12)


def elf(parts, entry=0, segments=(), symbols=(), tables=()):
    """An ELF file. `parts` are sections as above; those of `tables` are relocations: the name of their section, then
    tuples of an offset, a kind and the number of a symbol."""
    image = bytearray(52 + 32 * len(segments))
    headers, names = [(0,) * 10], bytearray(b"\0")

    def add(name, kind, flags, address, data, link=0, info=0, entry_size=0):
        size = data if isinstance(data, int) else len(data)
        if kind != NOBITS:
            # A loaded section keeps its place in a page, like GNU ld's.
            image.extend(bytes((address - len(image)) % 0x1000 if flags & 2 else -len(image) % 4))
        headers.append((len(names), kind, flags, address, len(image), size, link, info, 4, entry_size))
        names.extend(name.encode() + b"\0")
        image.extend(b"" if kind == NOBITS else data)

    for part in parts:
        add(*part)
    if symbols:
        text, table = b"\0", bytes(16)
        for name in symbols:
            table += struct.pack("<IIIBBH", len(text), 0, 0, 16, 0, 0)
            text += name.encode() + b"\0"
        add(".strtab", STRTAB, 0, 0, text)
        add(".symtab", SYMTAB, 0, 0, table, link=len(headers) - 1, info=1, entry_size=16)
        symbol_table = len(headers) - 1
        for name, entries in tables:
            number = 1 + [part[0] for part in parts].index(name)
            data = b"".join(struct.pack("<II", offset, symbol << 8 | kind) for offset, kind, symbol in entries)
            add(".rel" + name, REL, 0, 0, data, link=symbol_table, info=number, entry_size=8)
    add(".shstrtab", STRTAB, 0, 0, bytes(names) + b".shstrtab\0")
    image.extend(bytes(-len(image) % 4))
    struct.pack_into("<16sHHIIIIIHHHHHH", image, 0, b"\x7fELF\1\1\1", 2, 8, 1, entry, 52, len(image), 0x1007, 52, 32,
                     len(segments), 40, len(headers), len(headers) - 1)
    for number, segment in enumerate(segments):
        struct.pack_into("<8I", image, 52 + 32 * number, *segment)
    for fields in headers:
        image.extend(struct.pack("<10I", *fields))
    return bytes(image)


def linked(relocations=((0, R_MIPS_32, 1), (12, R_MIPS_32, 1)), **contents):
    """As GNU ld leaves it with --emit-relocs. The relocations are those of .data, by their offsets in it."""
    return elf(sections(**contents), TEXT_AT, symbols=("name", "_gp_disp"),
               tables=((".text", ((TEXT_AT, R_MIPS_HI16, 2), (TEXT_AT + 4, R_MIPS_LO16, 2))),
                       (".data", tuple((DATA_AT + offset, *rest) for offset, *rest in relocations))))


def tables(program, relocated=RELOCATED, entry=TEXT_AT, stack=32768, count=None):
    """As gensnap makes them for a program with these sections. `relocated` are the places of its addresses."""
    contents = {address + at: struct.unpack_from("<I", data, at)[0]
                for _, kind, _, address, data in program if kind == PROGBITS for at in range(0, len(data) - 3, 4)}
    values = [(place, contents.get(place, BASE)) for place in relocated]
    entries = b"".join(words(1, 2, place - BASE, value - BASE if value else 0) for place, value in values)
    header = (b"Test".ljust(64, b"\0") * 2 + words(1) + b"mCOOP".ljust(64, b"\0") +
              words(stack, 65536, 0, 3, 1, 1, 64, 0, 112)).ljust(512, b"\0")
    oblet = words(0) + b"MCoopOblet".ljust(64, b"\0") + bytes(8)
    numbers = words(0x16, 0, 0, 0x19, 0, 0x8000, entry - BASE, 0, 0, len(values) if count is None else count, 0)
    return elf([(".SnapShotHdr", PROGBITS, 3, TABLES_AT, header),
                *((name, PROGBITS, 0, TABLES_AT, data) for name, data in (
                    (".ObletDependencyDescr", oblet), (".ObletDependencyDescrList", words(1, 0)),
                    (".RelEntry", numbers), (".RelDataEntry", entries))),
                (".Dummy", NOBITS, 7, TABLES_AT, 0x40)])
