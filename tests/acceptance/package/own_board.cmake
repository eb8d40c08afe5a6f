# Builds the unit of a board of a project's own for NAME, a toolchain file: from the package, and with the sources as a
# subdirectory. What is missing is named.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

set(project "${FOLDER}/own_board")
set(data "${FOLDER}/prefix/share/sonoglide")
foreach(sonoglide PREFIX SOURCE)
  set(build "${FOLDER}/build_own_board_${NAME}")
  file(REMOVE_RECURSE "${build}")
  if(sonoglide STREQUAL "PREFIX")
    set(how "-DCMAKE_PREFIX_PATH=${FOLDER}/prefix" "-DCMAKE_TOOLCHAIN_FILE=${data}/toolchains/${NAME}.cmake")
  else()
    set(how "-DSONOGLIDE_SOURCE=${SOURCE}" "-DCMAKE_TOOLCHAIN_FILE=${SOURCE}/tools/toolchains/${NAME}.cmake")
  endif()
  run("${CMAKE_COMMAND}" -G Ninja -S "${project}" -B "${build}" ${how})
  run("${CMAKE_COMMAND}" --build "${build}")
  expect("${output}" HAS "controller_unit.elf")
  file(READ "${build}/CMakeFiles/controller_unit.dir/checksum" checksum HEX)
  file(READ "${build}/controller_unit.elf" image HEX)
  expect("${checksum}" HAS "63726300")
  expect("${image}" HAS "${checksum}")
endforeach()

# refused(<from> <to> <message>): the project with a change.
function(refused from to reason)
  set(spoilt "${FOLDER}/spoilt_own_board_${NAME}")
  file(REMOVE_RECURSE "${spoilt}")
  file(READ "${project}/CMakeLists.txt" text)
  string(REPLACE "${from}" "${to}" text "${text}")
  file(WRITE "${spoilt}/CMakeLists.txt" "${text}")
  file(COPY "${project}/hal" DESTINATION "${spoilt}")
  execute_process(COMMAND "${CMAKE_COMMAND}" -G Ninja -S "${spoilt}" -B "${spoilt}/build"
      "-DCMAKE_PREFIX_PATH=${FOLDER}/prefix" "-DCMAKE_TOOLCHAIN_FILE=${data}/toolchains/${NAME}.cmake"
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(result EQUAL 0)
    message(FATAL_ERROR "${to} in place of ${from} is not refused")
  endif()
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  expect("${output}" HAS "${reason}")
endfunction()

refused("  CONTROLLERS controller" "" "sonoglide_timed_board(product): CONTROLLERS is missing")
refused("MEMORY hal" "MEMROY hal" "sonoglide_timed_board(product): unknown: MEMROY;hal/template/memory.ld; there are HEADER")
refused("MEMORY hal/template/memory.ld" "MEMORY" "sonoglide_timed_board(product): without a value: MEMORY")
refused("  CONTROLLERS" "  INTERRUPTS 481 CONTROLLERS"
  "sonoglide_timed_board(product): INTERRUPTS 481; allowed: a whole number from 1 to 480")
refused("(product" "(seventeen-letters"
  "sonoglide_timed_board(seventeen-letters): the name of a board has 1 to 16 letters")
refused("::Hardware" "::Hardwear"
  "sonoglide_timed_board(product): HARDWARE sonoglide::hal::template_board::Hardwear: there is no Hardwear in")
refused("memory.ld" "memroy.ld" "sonoglide_timed_board(product): MEMORY hal/template/memroy.ld: there is no")
refused("controller)" "elsewhere)" "elsewhere has no controller_configuration.hpp: sonoglide configure SCENE --out")
