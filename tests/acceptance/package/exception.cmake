# A unit of a project elsewhere, for a board that an emulator knows: an exception in it is kept over the reset, told to
# its host, and found in the source.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

set(project "${FOLDER}/trapping")
file(REMOVE_RECURSE "${project}")
file(COPY "${CMAKE_CURRENT_LIST_DIR}/trapping" DESTINATION "${FOLDER}")
file(COPY "${SOURCE}/hal/mps2" "${SOURCE}/hal/lockstep" DESTINATION "${project}/hal")
file(COPY "${FOLDER}/own_board/controller" DESTINATION "${project}")
run("${CMAKE_COMMAND}" -G Ninja -S "${project}" -B "${project}/build" "-DCMAKE_PREFIX_PATH=${FOLDER}/prefix"
  "-DCMAKE_TOOLCHAIN_FILE=${FOLDER}/prefix/share/sonoglide/toolchains/arm-cortex-m4f.cmake")
run("${CMAKE_COMMAND}" --build "${project}/build")
run("${PYTHON}" "${CMAKE_CURRENT_LIST_DIR}/exception_test.py" "${FOLDER}/prefix/bin/sonoglide"
  "${project}/build/controller_unit.elf" "${project}/board.hpp")
