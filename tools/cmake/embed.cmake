# Builds a file into a target, as a function that returns its bytes.
#
# sonoglide_embed(<target> HEADER <declares it> NAMESPACE <n> FUNCTION <f> FILE <path>)
# defines std::string_view n::f(). At build time the same file runs as a script.

if(CMAKE_SCRIPT_MODE_FILE)
  file(READ "${FILE}" bytes HEX)
  if(bytes STREQUAL "")
    message(FATAL_ERROR "${FILE} is empty")
  endif()
  string(REGEX REPLACE "(..)" "\\\\x\\1" bytes "${bytes}")
  file(WRITE "${OUTPUT}"
    "#include \"${HEADER}\"\n\n"
    "// A literal compiles far faster than an array of as many characters.\n"
    "std::string_view ${NAMESPACE}::${FUNCTION}() {\n"
    "  static constexpr char bytes[] = \"${bytes}\";\n"
    "  return {bytes, sizeof bytes - 1};\n"
    "}\n")
  return()
endif()

set(SONOGLIDE_EMBED_SCRIPT "${CMAKE_CURRENT_LIST_FILE}")

function(sonoglide_embed target)
  cmake_parse_arguments(EMBED "" "HEADER;NAMESPACE;FUNCTION;FILE" "" ${ARGN})
  set(source "${PROJECT_BINARY_DIR}/embedded/${target}/${EMBED_FUNCTION}.cpp")
  add_custom_command(
    OUTPUT "${source}"
    COMMAND "${CMAKE_COMMAND}"
      "-DFILE=${EMBED_FILE}" "-DOUTPUT=${source}" "-DHEADER=${EMBED_HEADER}"
      "-DNAMESPACE=${EMBED_NAMESPACE}" "-DFUNCTION=${EMBED_FUNCTION}"
      -P "${SONOGLIDE_EMBED_SCRIPT}"
    DEPENDS "${EMBED_FILE}" "${SONOGLIDE_EMBED_SCRIPT}"
    COMMENT "Embedding ${EMBED_FILE}"
    VERBATIM)
  target_sources(${target} PRIVATE "${source}")
endfunction()
