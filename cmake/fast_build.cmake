# Makes a build from scratch faster. Most compile time goes into the headers of ROS, Qt and GoogleTest, so a target
# reads them once (precompiled header). Even then, each compiler process needs a second for them. So sources are compiled
# together (unity build), but only so many that a build after a change of one file does not become much slower.
option(AIBO_FAST_BUILD "Precompile headers, and compile several sources together" ON)
if(AIBO_SANITIZE STREQUAL "fuzz")
  set(AIBO_FAST_BUILD OFF)  # it builds little, with clang
endif()

if(AIBO_FAST_BUILD)
  # Targets can share a precompiled header only if they are position independent in the same way and define the same
  # names, such as _REENTRANT. Functions of a program can still be inlined: nobody replaces one of them.
  add_compile_options(-fPIC -fno-semantic-interposition)
  # GCC forgets that a template in a precompiled header is a system one, and warns about Boost's functions.
  add_compile_options(-Wno-maybe-uninitialized)
  add_compile_definitions(_REENTRANT)
  # gold links in half of the time. Not every system has it.
  find_program(AIBO_GOLD ld.gold)
  if(AIBO_GOLD AND NOT AIBO_SANITIZE)
    add_link_options(-fuse-ld=gold)
  endif()
endif()

# aibo_precompile_headers(TARGET HEADER...)
function(aibo_precompile_headers target)
  if(AIBO_FAST_BUILD)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# aibo_reuse_headers(OWNER TARGET...): the targets use the owner's precompiled header and its options.
function(aibo_reuse_headers owner)
  if(AIBO_FAST_BUILD)
    foreach(target ${ARGN})
      target_precompile_headers(${target} REUSE_FROM ${owner})
    endforeach()
  endif()
endfunction()

# Names in anonymous namespaces have to be unique in such a target.
function(aibo_compile_together)
  if(AIBO_FAST_BUILD)
    set_target_properties(${ARGN} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
  endif()
endfunction()
