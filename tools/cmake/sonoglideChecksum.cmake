# sonoglide_image_checksum(<target>): writes the checksum that the image tests itself by (hal/start/stored_image.hpp)
# into it, once it is linked; before any other step that makes a file of it. Without this the image counts as damaged.
#
# objcopy alone does it, as every toolchain has one: it writes the CRC-32 of IEEE 802.3 of a file, behind the name of
# that file, as the section .gnu_debuglink (GDB manual, Separate Debug Files).
function(sonoglide_image_checksum target)
  if(NOT CMAKE_OBJCOPY)
    message(FATAL_ERROR "sonoglide_image_checksum(${target}): the toolchain has no objcopy; set CMAKE_OBJCOPY")
  endif()
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${target}.dir")
  set(image "$<TARGET_FILE:${target}>")
  set(stored "${folder}/crc")  # three letters: name and checksum fill the section
  set(linked "${folder}/linked")
  add_custom_command(TARGET ${target} POST_BUILD VERBATIM
    COMMAND "${CMAKE_OBJCOPY}" -O binary -j .boot -j .text -j .rodata -j .data "${image}" "${stored}"
    COMMAND "${CMAKE_OBJCOPY}" "--add-gnu-debuglink=${stored}" "${image}" "${linked}"
    COMMAND "${CMAKE_OBJCOPY}" "--dump-section=.gnu_debuglink=${folder}/checksum" "${linked}"
    COMMAND "${CMAKE_OBJCOPY}" "--update-section=.image_checksum=${folder}/checksum" "${image}")
endfunction()
