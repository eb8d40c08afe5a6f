# Debian packages: cmake --build --preset release --target packages
# sonoglide: the program, its manual, scenes, documents, and the sources that `pil` builds images from
# and that an FMU carries;
# libsonoglide-dev: the core for somebody else's firmware. Included after every install rule.
find_program(SONOGLIDE_HELP2MAN help2man)
if(NOT SONOGLIDE_HELP2MAN)
  return()
endif()

set(debian "${PROJECT_BINARY_DIR}/debian")
add_custom_target(packages
  COMMAND "${CMAKE_COMMAND}" "-DPROGRAM=$<TARGET_FILE:sonoglide>" "-DHELP2MAN=${SONOGLIDE_HELP2MAN}"
    "-DVERSION=${PROJECT_VERSION}" "-DSOURCE=${PROJECT_SOURCE_DIR}" "-DFOLDER=${debian}"
    -P "${PROJECT_SOURCE_DIR}/tools/debian/prepare.cmake"
  COMMAND "${CMAKE_CPACK_COMMAND}" --config "${PROJECT_BINARY_DIR}/CPackConfig.cmake"
    -B "${PROJECT_BINARY_DIR}/packages"
  DEPENDS sonoglide VERBATIM USES_TERMINAL)

set(shares "${CMAKE_INSTALL_DATADIR}")
install(FILES "${PROJECT_SOURCE_DIR}/CMakeLists.txt"
  DESTINATION "${SONOGLIDE_DATA_FOLDER}/source" COMPONENT images EXCLUDE_FROM_ALL)
foreach(folder firmware hal tools/cmake tools/toolchains host_sim/fmi host_sim/loop host_sim/configure
    host_sim/scene host_sim/scene_file host_sim/process)
  cmake_path(GET folder PARENT_PATH inside)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/${folder}"
    DESTINATION "${SONOGLIDE_DATA_FOLDER}/source/${inside}" COMPONENT images EXCLUDE_FROM_ALL
    PATTERN "*.md" EXCLUDE)
endforeach()
install(DIRECTORY "${debian}/man/" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1"
  COMPONENT manual EXCLUDE_FROM_ALL)
install(FILES "${debian}/sonoglide" DESTINATION "${shares}/bash-completion/completions"
  COMPONENT manual EXCLUDE_FROM_ALL)
install(FILES "${debian}/_sonoglide" DESTINATION "${shares}/zsh/vendor-completions"
  COMPONENT manual EXCLUDE_FROM_ALL)
install(FILES "${debian}/sonoglide.fish" DESTINATION "${shares}/fish/vendor_completions.d"
  COMPONENT manual EXCLUDE_FROM_ALL)
foreach(package sonoglide libsonoglide-dev)
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" RENAME copyright
    DESTINATION "${shares}/doc/${package}" COMPONENT ${package}_notes EXCLUDE_FROM_ALL)
  install(FILES "${debian}/changelog.gz"
    DESTINATION "${shares}/doc/${package}" COMPONENT ${package}_notes EXCLUDE_FROM_ALL)
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME sonoglide)
set(CPACK_PACKAGE_CONTACT "Sonoglide <sonoglide@packages.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENTS_ALL program documents images manual core sonoglide_notes libsonoglide-dev_notes)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_SONOGLIDE_PACKAGE_NAME sonoglide)
set(CPACK_DEBIAN_SONOGLIDE_PACKAGE_SECTION science)
set(CPACK_DEBIAN_SONOGLIDE_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_SONOGLIDE_PACKAGE_DEPENDS "gnuplot-nox")
set(CPACK_DEBIAN_SONOGLIDE_PACKAGE_RECOMMENDS "cmake, ninja-build, gcc-arm-none-eabi, \
libnewlib-arm-none-eabi, libstdc++-arm-none-eabi-newlib, qemu-system-arm")
set(CPACK_DEBIAN_SONOGLIDE_PACKAGE_SUGGESTS
  "gcc-riscv64-unknown-elf, picolibc-riscv64-unknown-elf, qemu-system-misc")
set(CPACK_COMPONENT_SONOGLIDE_DESCRIPTION
  "Simulates a resonator that slides with friction under a piezo drive, and the
controller firmware that holds its friction ratio at a target. The controller
also runs as a firmware image on emulated boards.")
set(CPACK_DEBIAN_LIBSONOGLIDE-DEV_PACKAGE_NAME libsonoglide-dev)
set(CPACK_DEBIAN_LIBSONOGLIDE-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBSONOGLIDE-DEV_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_LIBSONOGLIDE-DEV_DESCRIPTION
  "Headers of a controller of friction by ultrasonic vibration, of friction laws
and of plant solvers. Portable C++17 without heap, for firmware and for
simulation, as a CMake package and a pkg-config module.")

include(CPack)
cpack_add_component_group(sonoglide)
cpack_add_component_group(libsonoglide-dev)
foreach(component program documents images manual sonoglide_notes)
  cpack_add_component(${component} GROUP sonoglide)
endforeach()
foreach(component core libsonoglide-dev_notes)
  cpack_add_component(${component} GROUP libsonoglide-dev)
endforeach()
