/* Does what the robot's loader does with a program: places it at an address, adapts the words that .RelDataEntry names,
   and calls its entry. Prints what the entry returns for the numbers from 1 to 6. For MIPS, to be run by QEMU.

   place PROGRAM IMAGE_SIZE MEMORY TABLE TABLE_SIZE ENTRY ADDRESS: sizes, places in the file and the address in
   hexadecimal digits */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/cachectl.h>
#include <sys/mman.h>

static uint32_t number(const char* digits) {
  return strtoul(digits, NULL, 16);
}

int main(int count, char** arguments) {
  static uint8_t file[4 << 20];
  FILE* program = fopen(arguments[1], "rb");
  if (count != 8 || program == NULL || fread(file, 1, sizeof file, program) == 0) {
    return 2;
  }
  const uint32_t size = number(arguments[2]), memory = number(arguments[3]), entry = number(arguments[6]);
  uint8_t* const base = mmap((void*)(uintptr_t)number(arguments[7]), memory, PROT_READ | PROT_WRITE | PROT_EXEC,
                             MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0);
  if (base == MAP_FAILED) {
    return 3;
  }
  memcpy(base, file, size);
  const uint32_t* word = (const uint32_t*)(file + number(arguments[4]));
  for (uint32_t left = number(arguments[5]) / 16; left > 0; --left, word += 4) {
    const uint32_t adapted = word[3] + (uint32_t)(uintptr_t)base;
    memcpy(base + word[2], &adapted, sizeof adapted);
  }
  cacheflush(base, memory, BCACHE);
  int (*const run)(int) = (int (*)(int))(base + entry);
  for (int i = 1; i <= 6; ++i) {
    printf("%d\n", run(i));
  }
  return 0;
}
