# Controller images for boards. On the workstation:
#
#   sonoglide configure SCENE.toml --out FOLDER
#   cmake --toolchain tools/toolchains/arm-cortex-m4f.cmake -S . -B BUILD \
#     -DSONOGLIDE_CONTROLLERS=FOLDER
#   cmake --build BUILD
#
# leaves BUILD/bin/<name of FOLDER>.elf.

sonoglide_room(sonoglide_lockstep hal/mps2/lockstep USES sonoglide_hal)

# sonoglide_image(<folder>): the image of one configured controller.
function(sonoglide_image folder)
  get_filename_component(name "${folder}" NAME)
  set(memory "${PROJECT_SOURCE_DIR}/hal/mps2/memory.ld")
  add_executable(${name} "${PROJECT_SOURCE_DIR}/firmware/app/image/main.cpp")
  target_include_directories(${name} PRIVATE "${folder}")
  target_link_libraries(${name} PRIVATE
    sonoglide_app sonoglide_hal_mps2 sonoglide_freestanding sonoglide_warnings)
  target_link_options(${name} PRIVATE "-T${memory}")
  set_target_properties(${name} PROPERTIES LINK_DEPENDS "${memory}")
endfunction()

if(CMAKE_CROSSCOMPILING)
  set(SONOGLIDE_CONTROLLERS "" CACHE STRING
    "Folders with a controller_configuration.hpp; each gives an image of its name")
  sonoglide_room(sonoglide_hal_mps2 hal/mps2 USES sonoglide_lockstep)
  foreach(folder IN LISTS SONOGLIDE_CONTROLLERS)
    sonoglide_image("${folder}")
  endforeach()
endif()
