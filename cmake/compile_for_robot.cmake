# For code that the robot's compiler must accept, which knows only C++98.
function(aibo_compile_as_for_robot target)
  set_target_properties(${target} PROPERTIES CXX_STANDARD 98 CXX_EXTENSIONS OFF)
  aibo_strict_warnings(${target})
endfunction()

# For targets that are also built for the robot. A test compares their sources with memory_stick/programs/Makefile.
function(aibo_compile_for_robot target)
  set_property(GLOBAL APPEND PROPERTY AIBO_ROBOT_TARGETS ${target})
  aibo_compile_as_for_robot(${target})
endfunction()
