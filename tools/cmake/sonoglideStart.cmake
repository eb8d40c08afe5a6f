# sonoglide::start: from reset to main on a Cortex-M or a 32-bit RISC-V. Its sources are compiled with
# the image that links it; the image has a linker script and an end of its own, as in hal/template.
if(TARGET sonoglide::start)
  return()
endif()

add_library(sonoglide::start INTERFACE IMPORTED)
target_sources(sonoglide::start INTERFACE
  "${sonoglide_DATA_FOLDER}/hal/start/fill_memory.cpp"
  "${sonoglide_DATA_FOLDER}/hal/$<IF:$<STREQUAL:${CMAKE_SYSTEM_PROCESSOR},arm>,cortex_m,riscv>/start.cpp"
  $<$<STREQUAL:${CMAKE_SYSTEM_PROCESSOR},arm>:${sonoglide_DATA_FOLDER}/hal/cortex_m/vectors.cpp>)
target_compile_features(sonoglide::start INTERFACE cxx_std_17)
target_include_directories(sonoglide::start INTERFACE "${sonoglide_DATA_FOLDER}")
# The script of a board includes hal/start/sections.ld.
target_link_options(sonoglide::start INTERFACE "-L${sonoglide_DATA_FOLDER}")
