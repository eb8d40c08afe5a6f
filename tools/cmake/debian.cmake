# Debian packages: cmake --build --preset release --target packages
# sonoglide: the program, its manual, scenes, documents, and the sources that `pil` builds images
# from;
# libsonoglide-dev: the core for somebody else's firmware;
# python3-sonoglide: the Python module, where it is built. Included after every install rule.
find_program(SONOGLIDE_HELP2MAN help2man)
if(NOT SONOGLIDE_HELP2MAN)
  return()
endif()

set(debian "${PROJECT_BINARY_DIR}/debian")
set(packages sonoglide libsonoglide-dev)
if(TARGET sonoglide_python_module)
  list(APPEND packages python3-sonoglide)
endif()
add_custom_target(packages
  COMMAND "${CMAKE_COMMAND}" "-DPROGRAM=$<TARGET_FILE:sonoglide>" "-DHELP2MAN=${SONOGLIDE_HELP2MAN}"
    "-DVERSION=${PROJECT_VERSION}" "-DSOURCE=${PROJECT_SOURCE_DIR}" "-DFOLDER=${debian}"
    -P "${PROJECT_SOURCE_DIR}/tools/debian/prepare.cmake"
  COMMAND "${CMAKE_CPACK_COMMAND}" --config "${PROJECT_BINARY_DIR}/CPackConfig.cmake"
    -B "${PROJECT_BINARY_DIR}/packages"
  DEPENDS sonoglide $<TARGET_NAME_IF_EXISTS:sonoglide_python_module> VERBATIM USES_TERMINAL)

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
foreach(package IN LISTS packages)
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" RENAME copyright
    DESTINATION "${shares}/doc/${package}" COMPONENT ${package}_notes EXCLUDE_FROM_ALL)
  install(FILES "${debian}/changelog.gz"
    DESTINATION "${shares}/doc/${package}" COMPONENT ${package}_notes EXCLUDE_FROM_ALL)
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME sonoglide)
set(CPACK_PACKAGE_CONTACT "Sonoglide <sonoglide@packages.invalid>")
set(CPACK_SET_DESTDIR ON)  # an installed scene names its prefix, /usr
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(sonoglide_components program documents images manual)
set(libsonoglide-dev_components core)
set(python3-sonoglide_components python)
set(CPACK_COMPONENTS_ALL "")
foreach(package IN LISTS packages)
  list(APPEND ${package}_components ${package}_notes)
  list(APPEND CPACK_COMPONENTS_ALL ${${package}_components})
endforeach()
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
set(CPACK_DEBIAN_LIBSONOGLIDE-DEV_PACKAGE_RECOMMENDS sonoglide)
set(CPACK_COMPONENT_LIBSONOGLIDE-DEV_DESCRIPTION
  "Headers of a controller of friction by ultrasonic vibration, of friction laws
and of plant solvers. Portable C++17 without heap, for firmware and for
simulation, as a CMake package and a pkg-config module.")
# The file name of the compiled part names the interpreter that it is for.
set(CPACK_DEBIAN_PYTHON3-SONOGLIDE_PACKAGE_NAME python3-sonoglide)
set(CPACK_DEBIAN_PYTHON3-SONOGLIDE_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON3-SONOGLIDE_PACKAGE_SHLIBDEPS ON)
if(python3-sonoglide IN_LIST packages)
  find_package(Python REQUIRED COMPONENTS Interpreter)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON3-SONOGLIDE_PACKAGE_DEPENDS "python3 (>= 3.${Python_VERSION_MINOR}), \
python3 (<< 3.${next_minor}), python3-numpy")
endif()
set(CPACK_DEBIAN_PYTHON3-SONOGLIDE_PACKAGE_RECOMMENDS "sonoglide")
set(CPACK_DEBIAN_PYTHON3-SONOGLIDE_PACKAGE_SUGGESTS "python3-matplotlib, python3-scipy")
set(CPACK_COMPONENT_PYTHON3-SONOGLIDE_DESCRIPTION
  "Simulates a resonator that slides with friction under a piezo drive, one scene
or thousands, from Python. The controller that is shipped as firmware can be
stepped alone, in its codes. Results are numpy arrays.")

include(CPack)
foreach(package IN LISTS packages)
  cpack_add_component_group(${package})
  foreach(component IN LISTS ${package}_components)
    cpack_add_component(${component} GROUP ${package})
  endforeach()
endforeach()
