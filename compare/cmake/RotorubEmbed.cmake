set(ROTORUB_EMBED_TEMPLATE "${CMAKE_CURRENT_LIST_DIR}/embed.cc.in")

# rotorub_embed(<target> <name> <file>)
#
# Embeds the file in the target as the result of `std::string_view rotorub::<name>()`, which a header of the target
# declares. The target is rebuilt when the file changes.
function(rotorub_embed target name file)
  cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
  set(unit "${CMAKE_CURRENT_BINARY_DIR}/${name}.cc")
  configure_file("${ROTORUB_EMBED_TEMPLATE}" "${unit}" @ONLY)
  set_source_files_properties("${unit}" PROPERTIES OBJECT_DEPENDS "${file}"
                                                    SKIP_PRECOMPILE_HEADERS ON)
  target_sources(${target} PRIVATE "${unit}")
endfunction()

# rotorub_embed_packed(<target> <name> <file>)
#
# Embeds the file compressed with gzip; a page decompresses it when it needs it.
function(rotorub_embed_packed target name file)
  set(packed "${CMAKE_CURRENT_BINARY_DIR}/${name}.gz")
  add_custom_command(
    OUTPUT "${packed}"
    COMMAND gzip -9nc "${file}" > "${packed}"
    DEPENDS "${file}"
    VERBATIM)
  rotorub_embed(${target} ${name} "${packed}")
endfunction()

# rotorub_bundle(<target> <name> <entry>)
#
# Embeds a script with all modules that it imports. esbuild bundles and minifies them for a plain <script>, because a
# page that is opened as a file cannot load modules. The target is rebuilt when any script in the folder of <entry>
# changes.
function(rotorub_bundle target name entry)
  cmake_path(ABSOLUTE_PATH entry BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
  cmake_path(GET entry PARENT_PATH folder)
  file(GLOB_RECURSE modules CONFIGURE_DEPENDS "${folder}/*.js")
  set(bundle "${CMAKE_CURRENT_BINARY_DIR}/${name}.bundle.js")
  add_custom_command(
    OUTPUT "${bundle}"
    COMMAND "${ROTORUB_WEB_DIR}/esbuild" "${entry}" --bundle --minify --format=iife --target=es2020 --charset=utf8 --log-level=warning
            "--alias:three=${ROTORUB_WEB_DIR}/three.module.js" "--outfile=${bundle}"
    DEPENDS ${modules} "${ROTORUB_WEB_DIR}/three.module.js" "${ROTORUB_WEB_DIR}/esbuild"
    VERBATIM)
  rotorub_embed(${target} ${name} "${bundle}")
endfunction()
