// A plugin for QEMU's user mode: counts the instructions that a program executes and writes them to stderr when it
// ends, function by function. A function is known by its symbol, so the program must be linked statically and not
// stripped.
//
//   qemu-mipsel -plugin ./libcount_instructions.so PROGRAM
//
// Debian does not package qemu-plugin.h. What follows is declared from QEMU's documentation of TCG plugins, version 1
// of its interface. One thread is assumed.
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef uint64_t qemu_plugin_id_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
typedef struct qemu_info_t qemu_info_t;
enum qemu_plugin_op { QEMU_PLUGIN_INLINE_ADD_U64 };
typedef void (*translation_callback)(qemu_plugin_id_t id, struct qemu_plugin_tb* tb);
typedef void (*exit_callback)(qemu_plugin_id_t id, void* data);

void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t id, translation_callback callback);
void qemu_plugin_register_atexit_cb(qemu_plugin_id_t id, exit_callback callback, void* data);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb* tb);
struct qemu_plugin_insn* qemu_plugin_tb_get_insn(const struct qemu_plugin_tb* tb, size_t index);
const char* qemu_plugin_insn_symbol(const struct qemu_plugin_insn* insn);
void qemu_plugin_register_vcpu_insn_exec_inline(struct qemu_plugin_insn* insn, enum qemu_plugin_op op, void* counter,
                                                uint64_t immediate);

#define EXPORTED __attribute__((visibility("default")))
EXPORTED int qemu_plugin_version = 1;

// A static program has a few thousand functions.
enum { SLOTS = 1 << 16 };
static struct {
  char* name;
  uint64_t instructions;
} functions[SLOTS];

static uint64_t* counter_of(const char* name) {
  uint32_t slot = 0;
  for (const char* c = name; *c != '\0'; ++c) {
    slot = 31 * slot + (unsigned char)*c;
  }
  for (slot %= SLOTS; functions[slot].name != NULL; slot = (slot + 1) % SLOTS) {
    if (strcmp(functions[slot].name, name) == 0) {
      return &functions[slot].instructions;
    }
  }
  functions[slot].name = strdup(name);
  return &functions[slot].instructions;
}

static void translated(qemu_plugin_id_t id, struct qemu_plugin_tb* tb) {
  (void)id;
  for (size_t i = 0; i < qemu_plugin_tb_n_insns(tb); ++i) {
    struct qemu_plugin_insn* insn = qemu_plugin_tb_get_insn(tb, i);
    const char* symbol = qemu_plugin_insn_symbol(insn);
    qemu_plugin_register_vcpu_insn_exec_inline(insn, QEMU_PLUGIN_INLINE_ADD_U64,
                                               counter_of(symbol != NULL ? symbol : "?"), 1);
  }
}

static void print_counts(qemu_plugin_id_t id, void* data) {
  (void)id;
  (void)data;
  for (size_t slot = 0; slot < SLOTS; ++slot) {
    if (functions[slot].instructions > 0) {
      fprintf(stderr, "%llu %s\n", (unsigned long long)functions[slot].instructions, functions[slot].name);
    }
  }
}

EXPORTED int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t* info, int argc, char** argv) {
  (void)info;
  (void)argc;
  (void)argv;
  qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
  qemu_plugin_register_atexit_cb(id, print_counts, NULL);
  return 0;
}
