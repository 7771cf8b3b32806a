/* The last words of the tables that begin.S begins. InitGlobals() expects one more word after the last constructor. */
        .section .ctors, "aw"
        .word 0
        .section .dtors, "aw"
        .word 0
        .section .note.GNU-stack, ""
