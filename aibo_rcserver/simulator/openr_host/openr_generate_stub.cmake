# openr_generate_stub(TARGET STUB_CFG [OBJECT_OCF])
#
# Generates sources from an OPEN-R object's stub.cfg for the target with the object's sources: def.h and entry.h to
# include, and OBJECTNAME_stub.h with describeOBJECTNAME(), from which a machine creates the object. Call it in the
# target's folder. The object's class is OBJECTNAME, in OBJECTNAME.h.
#
# OBJECT_OCF, used for the robot's build, gives the priority: "object NAME STACK HEAP PRIORITY ...". The default is 128.
function(openr_generate_stub target stub_cfg)
  get_filename_component(stub_cfg ${stub_cfg} ABSOLUTE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${stub_cfg})
  file(READ ${stub_cfg} text)
  if(NOT text MATCHES "(^|\n)[ \t]*ObjectName[ \t]*:[ \t]*([A-Za-z_0-9]+)")
    message(FATAL_ERROR "${stub_cfg}: the line 'ObjectName : NAME' is missing")
  endif()
  set(object ${CMAKE_MATCH_2})

  set(priority 128)
  if(ARGC GREATER 2)
    get_filename_component(ocf ${ARGV2} ABSOLUTE)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${ocf})
    file(READ ${ocf} text)
    if(NOT text MATCHES "object[ \t]+${object}[ \t]+[0-9]+[ \t]+[0-9]+[ \t]+([0-9]+)")
      message(FATAL_ERROR "${ocf}: the line 'object ${object} STACK HEAP PRIORITY ...' is missing")
    endif()
    set(priority ${CMAKE_MATCH_1})
  endif()

  # Only the object's own sources may find its def.h and entry.h.
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${object}_stub)
  set(public_folder ${folder}/public)
  file(MAKE_DIRECTORY ${public_folder})
  set(headers ${folder}/def.h ${folder}/entry.h ${public_folder}/${object}_stub.h)
  set(source ${folder}/${object}_stub.cc)
  add_custom_command(OUTPUT ${headers} ${source}
    COMMAND openr_stub_generator ${stub_cfg} ${priority} ${folder} ${public_folder}
    DEPENDS openr_stub_generator ${stub_cfg}
    COMMENT "Generating the stub of ${object}"
    VERBATIM)
  # The object may be C++98, but its description is not. C++17 has std::byte, which would collide with the SDK's byte in
  # objects that are using namespace std.
  set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS "-std=c++14")
  target_sources(${target} PRIVATE ${headers} ${source})
  target_include_directories(${target} PRIVATE ${folder} PUBLIC ${public_folder})
  target_link_libraries(${target} PUBLIC openr_host)
endfunction()
