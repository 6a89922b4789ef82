# rotorub_own_math(<target>): sin, cos, pow, ... of one fixed library as a part of the static library <target>.
#
# The C library picks its functions by the processor it finds at run time (with and without FMA), and they differ
# in the last bit. These are musl's: plain C, compiled once for the whole architecture, the same bits everywhere.
# One relocatable object is made of the members of musl's libc.a that hold them; it shows the names of PUBLIC
# below and nothing else, and as a member of the archive it is what its users' references find before libm.
# Functions that are exact in any library (sqrt, floor, fmod, ...) stay the C library's.
function(rotorub_own_math target)
  set(PUBLIC
      sin cos sincos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh
      exp exp2 exp10 expm1 log log2 log10 log1p pow cbrt hypot cabs carg csqrt)
  # What those need of each other.
  set(INTERNAL
      __sin __cos __tan __rem_pio2 __rem_pio2_large __expo2 __math_divzero __math_invalid __math_oflow
      __math_uflow __math_xflow exp_data log_data log2_data pow_data sqrt fabs floor copysign modf scalbn)

  find_file(ROTORUB_MUSL_LIBC libc.a PATHS "/usr/lib/${CMAKE_SYSTEM_PROCESSOR}-linux-musl" REQUIRED
            NO_DEFAULT_PATH DOC "musl's static C library (Debian: musl-dev)")
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/own_math")
  file(MAKE_DIRECTORY "${folder}")
  list(TRANSFORM PUBLIC APPEND ".lo" OUTPUT_VARIABLE public_members)
  list(TRANSFORM INTERNAL APPEND ".lo" OUTPUT_VARIABLE internal_members)
  list(JOIN PUBLIC "\n" names)
  file(GENERATE OUTPUT "${folder}/names" CONTENT "${names}\n")
  add_custom_command(
    OUTPUT "${folder}/own_math.o"
    COMMAND "${CMAKE_AR}" x "${ROTORUB_MUSL_LIBC}" ${public_members} ${internal_members}
    COMMAND "${CMAKE_LINKER}" -r -o all.o ${public_members} ${internal_members}
    COMMAND "${CMAKE_OBJCOPY}" --strip-debug "--keep-global-symbols=names" all.o own_math.o
    DEPENDS "${ROTORUB_MUSL_LIBC}" "${folder}/names"
    WORKING_DIRECTORY "${folder}"
    COMMENT "Taking the mathematical functions out of ${ROTORUB_MUSL_LIBC}"
    VERBATIM)
  set_source_files_properties("${folder}/own_math.o" PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
  target_sources(${target} PRIVATE "${folder}/own_math.o")
  # A program that showed them would hand them to every library that it loads.
  target_link_options(${target} INTERFACE "LINKER:--exclude-libs,${CMAKE_STATIC_LIBRARY_PREFIX}${target}${CMAKE_STATIC_LIBRARY_SUFFIX}")
endfunction()
