# Compiles the stranger's controller for the workstation with nothing but what pkg-config says.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

set(ENV{PKG_CONFIG_PATH} "${FOLDER}/prefix/share/pkgconfig")
run("${PKG_CONFIG}" --cflags sonoglide)
separate_arguments(flags UNIX_COMMAND "${output}")
expect("${output}" HAS "-ffp-contract=off")
set(project "${FOLDER}/stranger")
run("${COMPILER}" ${flags} "-I${project}" "-I${project}/controller" "${project}/workstation/main.cpp"
  -o "${FOLDER}/product_by_pkg_config")
run("${FOLDER}/product_by_pkg_config")
