# rotorub_own_math(<target>): sin, cos, pow, ... of one fixed library as a part of the static library <target>.
#
# The C library picks its functions by the processor it finds at run time (with and without FMA), and they differ
# in the last bit. These are musl's: plain C, compiled once for the whole architecture, the same bits everywhere.
# The linker takes them, and what they need of each other, out of musl's libc.a; the object shows their names and
# nothing else, and as a member of the archive it is what its users' references find before libm. Functions that
# are exact in any library (sqrt, floor, fmod, ...) stay the C library's.
function(rotorub_own_math target)
  set(functions
      sin cos sincos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh
      exp exp2 exp10 expm1 log log2 log10 log1p pow cbrt hypot cabs carg csqrt)
  find_file(ROTORUB_MUSL_LIBC libc.a PATHS "/usr/lib/${CMAKE_SYSTEM_PROCESSOR}-linux-musl" REQUIRED
            NO_DEFAULT_PATH DOC "musl's static C library (Debian: musl-dev)")
  set(object "${CMAKE_CURRENT_BINARY_DIR}/own_math.o")
  list(TRANSFORM functions PREPEND "--undefined=" OUTPUT_VARIABLE wanted)
  list(TRANSFORM functions PREPEND "--keep-global-symbol=" OUTPUT_VARIABLE shown)
  add_custom_command(
    OUTPUT "${object}"
    COMMAND "${CMAKE_LINKER}" -r -o "${object}" ${wanted} "${ROTORUB_MUSL_LIBC}"
    COMMAND "${CMAKE_OBJCOPY}" --strip-debug ${shown} "${object}"
    DEPENDS "${ROTORUB_MUSL_LIBC}"
    COMMENT "Taking the mathematical functions out of ${ROTORUB_MUSL_LIBC}"
    VERBATIM)
  set_source_files_properties("${object}" PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
  target_sources(${target} PRIVATE "${object}")
  # A program that showed them would hand them to every library that it loads.
  target_link_options(${target} INTERFACE "LINKER:--exclude-libs,${CMAKE_STATIC_LIBRARY_PREFIX}${target}${CMAKE_STATIC_LIBRARY_SUFFIX}")
endfunction()
