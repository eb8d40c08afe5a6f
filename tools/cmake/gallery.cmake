# cmake --build --preset release --target gallery: a site of example pages, documents and the reference of
# the core, in build/release/gallery/index.html. Needs pandoc, doxygen and, for one page, an emulated board.
find_program(SONOGLIDE_PYTHON3 python3)
if(SONOGLIDE_PYTHON3)
  add_custom_target(gallery
    COMMAND "${SONOGLIDE_PYTHON3}" -B "${PROJECT_SOURCE_DIR}/tools/gallery/build.py" "${PROJECT_SOURCE_DIR}"
      $<TARGET_FILE:sonoglide> "${PROJECT_BINARY_DIR}/gallery"
    DEPENDS sonoglide VERBATIM USES_TERMINAL)
endif()
