set(ROTORUB_EMBED_TEMPLATE "${CMAKE_CURRENT_LIST_DIR}/embed.cc.in")

# rotorub_embed(<target> <name> <file>)
#
# Makes the file a part of the target, as the result of `std::string_view rotorub::<name>()`, which a header
# of the target declares. A change of the file is a change of the target.
function(rotorub_embed target name file)
  cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
  set(unit "${CMAKE_CURRENT_BINARY_DIR}/${name}.cc")
  configure_file("${ROTORUB_EMBED_TEMPLATE}" "${unit}" @ONLY)
  set_source_files_properties("${unit}" PROPERTIES OBJECT_DEPENDS "${file}"
                                                    SKIP_PRECOMPILE_HEADERS ON)
  target_sources(${target} PRIVATE "${unit}")
endfunction()
