# A component that the package does not have is named, and what there is. So is a version.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

# refused(<arguments of find_package> <message>)
function(refused arguments reason)
  set(project "${FOLDER}/components")
  file(REMOVE_RECURSE "${project}")
  file(WRITE "${project}/CMakeLists.txt"
    "cmake_minimum_required(VERSION 3.25)\nproject(asks LANGUAGES NONE)\n"
    "find_package(sonoglide ${arguments})\n")
  execute_process(COMMAND "${CMAKE_COMMAND}" -G Ninja -S "${project}" -B "${project}/build"
      "-DCMAKE_PREFIX_PATH=${FOLDER}/prefix"
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(result EQUAL 0)
    message(FATAL_ERROR "find_package(sonoglide ${arguments}) is not refused")
  endif()
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  expect("${output}" HAS "${reason}")
endfunction()

refused("REQUIRED COMPONENTS core gui" "sonoglide has no component gui; there are core and start")
refused("REQUIRED COMPONENTS start" "sonoglide::start is for")
refused("99 REQUIRED" "sonoglideConfig.cmake, version:")
