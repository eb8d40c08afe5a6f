# Configures a project that fetches this one, and builds it with this one as a subdirectory, on a machine
# without the host's libraries. Its one source is all that there is to compile, and it has no tests.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

set(build "${FOLDER}/build_above")
file(REMOVE_RECURSE "${build}")
set(absent tomlplusplus CLI11 nlohmann_json fmt Eigen3 hwy TBB Boost GTest rapidcheck benchmark)
list(TRANSFORM absent REPLACE "(.+)" "-DCMAKE_DISABLE_FIND_PACKAGE_\\1=ON")
foreach(fetched ON OFF)
  run("${CMAKE_COMMAND}" -G Ninja -S "${FOLDER}/above" -B "${build}" --fresh --no-warn-unused-cli
    ${absent} "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DSONOGLIDE_SOURCE=${SOURCE}" -DFETCHED=${fetched}
    -DCMAKE_EXPORT_COMPILE_COMMANDS=ON)
endforeach()
run("${CMAKE_COMMAND}" --build "${build}")
run("${build}/product")

file(READ "${build}/compile_commands.json" commands)
string(JSON sources LENGTH "${commands}")
if(NOT sources EQUAL 1)
  message(FATAL_ERROR "${sources} sources are compiled:\n${commands}")
endif()
expect("${commands}" HAS "-ffp-contract=off")
expect("${commands}" HAS_NO "-Werror")
run("${CMAKE_CTEST_COMMAND}" --test-dir "${build}" --show-only)
expect("${output}" HAS "Total Tests: 0")
run("${CMAKE_COMMAND}" --install "${build}" --prefix "${build}/prefix")
if(EXISTS "${build}/prefix")
  message(FATAL_ERROR "A project above installs more than its own")
endif()
