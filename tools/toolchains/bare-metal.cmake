# What all microcontrollers share. The file that includes this has set the compiler, processor_flags, and
# what the linker needs besides: linker_flags, CMAKE_CXX_STANDARD_LIBRARIES_INIT.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_EXECUTABLE_SUFFIX_CXX .elf)
# What CMake tries out cannot be linked without a board.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)

# A controller's step becomes one function, in which its parameters are known: fewer instructions, and
# fewer bytes, than a call for each of its parts. Scheduling before registers are chosen would only
# make more of its numbers live at once than there are registers; after that it stays on. A jump through
# a table has no target that the analysis of the stack can see.
string(JOIN " " CMAKE_CXX_FLAGS_INIT
  ${processor_flags} -O2 -finline-limit=2000 -fno-schedule-insns -fno-jump-tables -g -ffp-contract=off -fno-exceptions -fno-rtti -fno-threadsafe-statics
  -ffunction-sections -fdata-sections)
# No start files and no system calls: what needs a heap or an operating system does not link.
string(JOIN " " CMAKE_EXE_LINKER_FLAGS_INIT
  -nostartfiles -Wl,--gc-sections -Wl,--fatal-warnings ${linker_flags})

# CMake keeps the flags with which a build folder was configured first. Where the toolchain files give others
# now, these take their place among those that somebody has added.
foreach(flags CMAKE_CXX_FLAGS CMAKE_EXE_LINKER_FLAGS CMAKE_CXX_STANDARD_LIBRARIES)
  if(DEFINED CACHE{${flags}} AND DEFINED CACHE{SONOGLIDE_${flags}})
    string(REPLACE "${SONOGLIDE_${flags}}" "${${flags}_INIT}" present "$CACHE{${flags}}")
    set_property(CACHE ${flags} PROPERTY VALUE "${present}")
  endif()
  set(SONOGLIDE_${flags} "${${flags}_INIT}" CACHE INTERNAL "As the toolchain files gave them")
endforeach()

# The workstation program and GoogleTest are not for a microcontroller.
set(SONOGLIDE_HOST OFF)
set(SONOGLIDE_TESTS OFF)
