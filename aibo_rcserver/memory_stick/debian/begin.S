/* The first words of the tables of constructors and destructors. OPEN-R's InitGlobals() runs the constructors from the
   last to the first, and stops at -1. */
        .section .ctors, "aw"
        .word -1
        .section .dtors, "aw"
        .word -1
        .section .note.GNU-stack, ""
