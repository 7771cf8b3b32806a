# openr_generate_stub(TARGET STUB_CFG)
#
# Adds to the target, which holds the sources of one OPEN-R object, what the object's stub.cfg says: def.h and entry.h
# for the object to include, and OBJECTNAME_stub.h with describeOBJECTNAME(), which a machine makes the object by.
# To be called in the folder of the target. The object's class is OBJECTNAME, in OBJECTNAME.h.
function(openr_generate_stub target stub_cfg)
  get_filename_component(stub_cfg ${stub_cfg} ABSOLUTE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${stub_cfg})
  file(READ ${stub_cfg} text)
  if(NOT text MATCHES "(^|\n)[ \t]*ObjectName[ \t]*:[ \t]*([A-Za-z_0-9]+)")
    message(FATAL_ERROR "${stub_cfg}: there is no ObjectName : NAME")
  endif()
  set(object ${CMAKE_MATCH_2})

  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${object}_stub)
  file(MAKE_DIRECTORY ${folder})
  set(headers ${folder}/def.h ${folder}/entry.h ${folder}/${object}_stub.h)
  set(source ${folder}/${object}_stub.cc)
  add_custom_command(OUTPUT ${headers} ${source}
    COMMAND openr_stub_generator ${stub_cfg} ${folder}
    DEPENDS openr_stub_generator ${stub_cfg}
    COMMENT "Generating the stub of ${object}"
    VERBATIM)
  # The object itself may be compiled as C++98; the machine's side of it is not.
  set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS "-std=c++17")
  target_sources(${target} PRIVATE ${headers} ${source})
  target_include_directories(${target} PUBLIC ${folder})
  target_link_libraries(${target} PUBLIC openr_host)
endfunction()
