"""GNU ld instead of the SDK's, with mkbin's calls. Today's ld cannot do two of mkbin's four steps:

- `ld -r` gives gensnap the relocations, but lays out the sections differently from the program, so gensnap would
  relocate the wrong words. Here they come from the program itself (--emit-relocs).
- `ld -T ldscript-merge` moves the program to address 0 and adds gensnap's tables. Today's ld refuses finished programs,
  and makes room for more headers, which moves everything but gensnap's addresses.
"""
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from stick.merge import merge, relocations_by_section  # noqa: E402

LD = "mipsel-linux-gnu-ld"


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
