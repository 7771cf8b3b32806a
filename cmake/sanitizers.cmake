# Builds with sanitizers. Each needs its own build folder: scripts/sanitize, scripts/fuzz.
set(AIBO_SANITIZE "" CACHE STRING
  "address (with undefined behaviour), thread, fuzz (libFuzzer with address, needs clang), or nothing")
set_property(CACHE AIBO_SANITIZE PROPERTY STRINGS "" address thread fuzz)

set(sanitizers_address address,undefined)
set(sanitizers_thread thread)
set(sanitizers_fuzz address,undefined,fuzzer-no-link)

if(AIBO_SANITIZE)
  if(NOT DEFINED sanitizers_${AIBO_SANITIZE})
    message(FATAL_ERROR "AIBO_SANITIZE is '${AIBO_SANITIZE}'; choose address, thread or fuzz.")
  endif()
  # The first finding ends the program and so fails the test. Frame pointers make stack traces complete.
  set(options -fsanitize=${sanitizers_${AIBO_SANITIZE}} -fno-sanitize-recover=all -fno-omit-frame-pointer -O1 -g1)
  add_compile_options(${options})
  add_link_options(${options})
  # With a sanitizer, GCC gives false warnings, for example about std::regex. Builds without one show the warnings that
  # count.
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-w>)
  # A program without the sanitizer has to load the sanitizer's library before a library of ours.
  set(sanitizer_library_address libasan.so)
  set(sanitizer_library_thread libtsan.so)
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=${sanitizer_library_${AIBO_SANITIZE}}
    OUTPUT_VARIABLE AIBO_SANITIZER_LIBRARY OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()
