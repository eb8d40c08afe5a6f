# A build folder follows toolchain files whose flags change, and keeps the flags that somebody has added.
# Usage: cmake -DTOOLCHAINS=tools/toolchains -DFOLDER=scratch -P toolchain_flags.cmake
file(REMOVE_RECURSE "${FOLDER}")
file(COPY "${TOOLCHAINS}/" DESTINATION "${FOLDER}/toolchains")
file(WRITE "${FOLDER}/CMakeLists.txt" [[
cmake_minimum_required(VERSION 3.25)
project(flags CXX)
file(WRITE "${CMAKE_BINARY_DIR}/flags" "${CMAKE_CXX_FLAGS} ${CMAKE_EXE_LINKER_FLAGS}")
]])

# expect(<as a regular expression>): of the flags in the next build.
function(expect flags)
  execute_process(COMMAND "${CMAKE_COMMAND}" --build "${FOLDER}/build" OUTPUT_QUIET
    COMMAND_ERROR_IS_FATAL ANY)
  file(READ "${FOLDER}/build/flags" found)
  if(NOT found MATCHES "^${flags}$")
    message(FATAL_ERROR "expected ${flags}, found\n${found}")
  endif()
endfunction()

execute_process(
  COMMAND "${CMAKE_COMMAND}" -E env CXXFLAGS=-gdwarf-4 "${CMAKE_COMMAND}" -G Ninja
    -S "${FOLDER}" -B "${FOLDER}/build"
    "-DCMAKE_TOOLCHAIN_FILE=${FOLDER}/toolchains/arm-cortex-m4f.cmake"
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
expect("-gdwarf-4 .* -O2 .* -nostartfiles .*")

file(READ "${FOLDER}/toolchains/bare-metal.cmake" toolchain)
string(REPLACE " -O2 " " -Os " toolchain "${toolchain}")
string(REPLACE "-nostartfiles " "-nostartfiles -nodefaultlibs " toolchain "${toolchain}")
file(WRITE "${FOLDER}/toolchains/bare-metal.cmake" "${toolchain}")
expect("-gdwarf-4 .* -Os .* -nostartfiles -nodefaultlibs .*")
