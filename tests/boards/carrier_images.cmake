# Images of boards that make the carrier in hardware, and what their controllers meet on the workstation.

# carrier_board(<board>): begins what the functions below add to.
macro(carrier_board board)
  set(folders "")
  set(written "")
  set(${board}_images "${CMAKE_CURRENT_BINARY_DIR}/images_of_${board}")
endmacro()

# carrier_controller(<board>/<name> <scene> <TABLE.KEY=VALUE>...): its header, and what it meets on the workstation.
function(carrier_controller name scene)
  set(file "${PROJECT_SOURCE_DIR}/host_sim/scenes/${scene}.toml")
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/controllers/${name}")
  set(header "${folder}/controller_configuration.hpp")
  list(TRANSFORM ARGN PREPEND "--set=" OUTPUT_VARIABLE settings)
  add_custom_command(OUTPUT "${header}"
    COMMAND sonoglide configure "${file}" --out "${folder}" --quiet ${settings}
    DEPENDS sonoglide "${file}" VERBATIM)
  set(outputs "${header}")
  if(NOT name MATCHES "/refused_")
    add_custom_command(OUTPUT "${folder}/trace"
      COMMAND board_trace "${file}" ${ARGN} > "${folder}/trace"
      DEPENDS board_trace "${file}" "${header}" VERBATIM)
    list(APPEND outputs "${folder}/trace")
  endif()
  set(folders ${folders} "${folder}" PARENT_SCOPE)
  set(written ${written} ${outputs} PARENT_SCOPE)
endfunction()

# carrier_refusal(<board> <name> <what the compiler says> <scene> <setting>...)
function(carrier_refusal board name reason scene)
  carrier_controller(${board}/refused_${name} ${scene} ${ARGN})
  carrier_refused(${board} ${name} ${reason})
  set(folders ${folders} PARENT_SCOPE)
  set(written ${written} PARENT_SCOPE)
endfunction()

# carrier_refused(<board> <name> <what the compiler or linker says>): of a controller that there is.
function(carrier_refused board name reason)
  set(test boards.${board}.${name}_is_refused)
  add_test(NAME ${test} COMMAND "${CMAKE_COMMAND}" --build "${${board}_images}" --target refused_${name}_unit)
  set_tests_properties(${test} PROPERTIES
    LABELS check PASS_REGULAR_EXPRESSION "${reason}" RESOURCE_LOCK images_${board})
endfunction()

# carrier_images(<board> <targets>... [SETTINGS <-Dname=value>...]): of the controllers so far.
function(carrier_images board)
  cmake_parse_arguments(IMAGES "" "" "SETTINGS" ${ARGN})
  add_custom_target(${board}_controllers DEPENDS ${written})
  list(JOIN folders "," folders)
  ExternalProject_Add(images_${board}
    SOURCE_DIR "${PROJECT_SOURCE_DIR}"
    BINARY_DIR "${${board}_images}"
    PREFIX "${CMAKE_CURRENT_BINARY_DIR}/images_${board}"
    LIST_SEPARATOR ","
    CONFIGURE_COMMAND "${CMAKE_COMMAND}" -S <SOURCE_DIR> -B <BINARY_DIR> --no-warn-unused-cli --preset ${board}
      "-DSONOGLIDE_CONTROLLERS=${folders}" ${IMAGES_SETTINGS}
    BUILD_COMMAND "${CMAKE_COMMAND}" --build <BINARY_DIR> --target ${IMAGES_UNPARSED_ARGUMENTS}
    BUILD_ALWAYS ON
    INSTALL_COMMAND ""
    DEPENDS ${board}_controllers)
  list(TRANSFORM IMAGES_UNPARSED_ARGUMENTS REPLACE "(.+)" "${${board}_images}/bin/\\1.elf" OUTPUT_VARIABLE files)
  list(JOIN files "," files)
  add_test(NAME boards.${board}.images_link_nothing_forbidden
    COMMAND "${CMAKE_COMMAND}" -DBINUTILS=arm-none-eabi "-DIMAGES=${files}"
      -P "${PROJECT_SOURCE_DIR}/tests/boards/image_check.cmake")
  set_tests_properties(boards.${board}.images_link_nothing_forbidden PROPERTIES LABELS check)
endfunction()
