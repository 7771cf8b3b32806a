# Warnings for all code of this project. They are errors unless a packager turns that off.
option(AIBO_WARNINGS_AS_ERRORS "Treat compiler warnings as errors" ON)

function(aibo_strict_warnings)
  foreach(target ${ARGN})
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wcast-align
      -Wnon-virtual-dtor -Woverloaded-virtual -Wunused
      $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>)  # GCC's -Wconversion does not include it
    if(AIBO_WARNINGS_AS_ERRORS)
      target_compile_options(${target} PRIVATE -Werror)
    endif()
  endforeach()
endfunction()
