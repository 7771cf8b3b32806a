# openr_generate_stub(TARGET OBJECT)
#
# Generates sources from the stub.cfg in the target's folder, for the target with the object's sources: def.h and
# entry.h to include, and OBJECT_stub.h with describeOBJECT(), from which a machine creates the object. OBJECT is the
# ObjectName in stub.cfg: the object's class, in OBJECT.h.
function(openr_generate_stub target object)
  # Only the object's own sources may find its def.h and entry.h.
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${object}_stub)
  set(public_folder ${folder}/public)
  file(MAKE_DIRECTORY ${public_folder})
  set(headers ${folder}/def.h ${folder}/entry.h ${public_folder}/${object}_stub.h)
  set(source ${folder}/${object}_stub.cc)
  set(generator ${PROJECT_SOURCE_DIR}/aibo_rcserver/simulator/openr_host/generate_stub)
  set(stub_cfg ${CMAKE_CURRENT_SOURCE_DIR}/stub.cfg)
  add_custom_command(OUTPUT ${headers} ${source}
    COMMAND ${generator} ${stub_cfg} ${folder} ${public_folder}
    DEPENDS ${generator} ${stub_cfg}
    COMMENT "Generating the stub of ${object}"
    VERBATIM)
  # The object may be C++98, but its description is not. C++17 has std::byte, which would collide with the SDK's byte in
  # objects that are using namespace std.
  set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS "-std=c++14")
  target_sources(${target} PRIVATE ${headers} ${source})
  target_include_directories(${target} PRIVATE ${folder} PUBLIC ${public_folder})
  target_link_libraries(${target} PUBLIC openr_host)
endfunction()
