# What must not link: each image is that of target_step with a line of code too many. Its folder joins
# the list of folders that the boards are configured with.
set(refused_heap "#include <cstdlib>
[[gnu::used, gnu::section(\".entry\")]] inline void* refused() { return std::malloc(4); }")
set(refused_abort "#include <cstdlib>
[[gnu::used, gnu::section(\".entry\")]] inline void refused() { std::abort(); }")
set(refused_constructor "inline volatile int seed = 1;
inline const int refused = seed + 1;")
set(refused_memory "[[gnu::used, gnu::section(\".entry\")]] inline char* refused() {
  static char buffer[13 * 1024];
  return buffer;
}")
foreach(name heap abort constructor memory)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/controllers/refused_${name}")
  file(CONFIGURE OUTPUT "${folder}/controller_configuration.hpp" @ONLY CONTENT
    "#include \"${CMAKE_CURRENT_BINARY_DIR}/controllers/target_step/controller_configuration.hpp\"
${refused_${name}}\n")
  string(APPEND folders ",${folder}")
endforeach()

# sonoglide_refuse_image(<board> <name> <what the linker says>)
function(sonoglide_refuse_image board name reason)
  set(test boards.${board}.${name}_does_not_link)
  add_test(NAME ${test}
    COMMAND "${CMAKE_COMMAND}" --build "${images}/${board}" --target refused_${name})
  set_tests_properties(${test} PROPERTIES
    PASS_REGULAR_EXPRESSION "${reason}" RESOURCE_LOCK images_${board})
endfunction()
sonoglide_refuse_image(microbit heap "undefined reference to `_sbrk'")
sonoglide_refuse_image(microbit abort "undefined reference to `_exit'")
sonoglide_refuse_image(microbit constructor "a static object has a constructor")
sonoglide_refuse_image(microbit memory "less than 4 KiB of RAM are left for the stack")
sonoglide_refuse_image(riscv32-virt heap "undefined reference to `__heap_")
sonoglide_refuse_image(riscv32-virt abort "undefined reference to `_exit'")
