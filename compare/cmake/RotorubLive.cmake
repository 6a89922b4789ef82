# The native model for pages ("what if", compare/report/live): `cmake --build build --target rotorub_live` makes
# lib/rotorub_native.wasm.gz with Debian's emscripten; the program looks for it there. The target is not part of `all`;
# without it pages have no sliders. The target `deb` builds and packs it if emscripten is installed (RotorubDeb);
# `cmake --install` installs it if it has been built.

set(ROTORUB_LIVE_MODULE "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/rotorub_native.wasm.gz")
set(live "${PROJECT_BINARY_DIR}/live")
find_program(ROTORUB_EMCMAKE emcmake)
if(ROTORUB_EMCMAKE)
  add_custom_target(
    rotorub_live
    COMMAND "${ROTORUB_EMCMAKE}" "${CMAKE_COMMAND}" -G Ninja -S "${PROJECT_SOURCE_DIR}/compare/report/live" -B "${live}"
    COMMAND "${CMAKE_COMMAND}" --build "${live}"
    COMMAND "${CMAKE_COMMAND}" -E make_directory "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}"
    # -n: the file does not contain the time, so equal input gives equal bytes.
    COMMAND gzip -9nkf "${live}/rotorub_native.wasm"
    COMMAND "${CMAKE_COMMAND}" -E rename "${live}/rotorub_native.wasm.gz" "${ROTORUB_LIVE_MODULE}"
    USES_TERMINAL VERBATIM)
else()
  add_custom_target(
    rotorub_live
    COMMAND "${CMAKE_COMMAND}" -E echo "rotorub_live needs emscripten: apt install emscripten, then configure again"
    COMMAND "${CMAKE_COMMAND}" -E false
    VERBATIM)
endif()
install(FILES "${ROTORUB_LIVE_MODULE}" DESTINATION "${CMAKE_INSTALL_LIBDIR}" OPTIONAL)
