# For targets that are also built for the robot, whose compiler knows C++98 and nothing newer. A test compares their
# sources with those of on_robot/Makefile.
function(aibo_compile_for_robot target)
  set_property(GLOBAL APPEND PROPERTY AIBO_ROBOT_TARGETS ${target})
  set_target_properties(${target} PROPERTIES CXX_STANDARD 98 CXX_EXTENSIONS OFF)
  aibo_strict_warnings(${target})
endfunction()
