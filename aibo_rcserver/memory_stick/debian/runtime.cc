/// @file runtime.cc
/// What OPEN-R's libraries need from the C++ library of GCC 3.3: memory, cout and program ends. The names come from the
/// C++ ABI (https://itanium-cxx-abi.github.io/cxx-abi/abi.html) and the standard of 1998.
#include <stdio.h>
#include <stdlib.h>

#include <iostream>
#include <new>

namespace {

void* allocate(size_t size) {
  void* const memory = malloc(size > 0 ? size : 1);
  if (memory == NULL) {
    printf("no memory is left for %u bytes: the program ends\n", static_cast<unsigned int>(size));
    abort();
  }
  return memory;
}

void end(const char* why) {
  printf("%s: the program ends\n", why);
  abort();
}

}  // namespace

void* operator new(size_t size) {
  return allocate(size);
}
void* operator new[](size_t size) {
  return allocate(size);
}
void operator delete(void* memory) throw() {
  free(memory);
}
void operator delete[](void* memory) throw() {
  free(memory);
}

namespace std {

/// The allocator of GCC 3.3's containers. The template arguments are needed because they are part of the symbols.
template <bool threads, int instance>
struct __default_alloc_template {
  static void* allocate(size_t size) { return ::allocate(size); }
  static void deallocate(void* memory, size_t) { free(memory); }
};
template struct __default_alloc_template<true, 0>;

template <>
ostream& ostream::operator<<(ostream& (*manipulator)(ostream&)) {
  return manipulator(*this);
}

template <>
ostream& ostream::operator<<(const void* address) {
  printf("%p", address);
  return *this;
}

template <>
ostream& ostream::operator<<(long number) {
  printf("%ld", number);
  return *this;
}

template <>
ostream& ostream::operator<<(unsigned long number) {
  printf("%lu", number);
  return *this;
}

template <>
ostream& operator<<(ostream& stream, const char* text) {
  fputs(text, stdout);
  return stream;
}

template <>
ostream& endl(ostream& stream) {
  putchar('\n');
  fflush(stdout);
  return stream;
}

ostream cout;

ios_base::Init::Init() {}
ios_base::Init::~Init() {}

}  // namespace std

extern "C" {

void __cxa_pure_virtual() {
  end("a pure virtual function was called");
}

// The libraries were built with exceptions, but nothing in these programs throws one.
void _Unwind_Resume(void*) {
  end("an exception was thrown");
}
int __gxx_personality_v0() {
  end("an exception was thrown");
  return 0;
}
void __register_frame_info(const void*, void*) {}
extern const void* const _ZTVN10__cxxabiv117__class_type_infoE[8] = {};
extern const void* const _ZTVN10__cxxabiv120__si_class_type_infoE[8] = {};
}
