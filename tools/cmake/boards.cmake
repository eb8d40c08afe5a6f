# Controller images for boards. On the workstation:
#
#   sonoglide configure SCENE.toml --out FOLDER
#   cmake --preset BOARD -DSONOGLIDE_CONTROLLERS=FOLDER
#   cmake --build --preset BOARD
#
# leaves build/BOARD/bin/<name of FOLDER>.elf, in lockstep with its host over semihosting, and
# <name of FOLDER>_serial.elf, over a serial line; and <name of FOLDER>_timed.elf, on the board's own
# timer, with a link. After configure --plant there is also <name of FOLDER>_plant.elf, which needs
# neither host nor hardware. A toolchain file without a board compiles the core alone.

include(sonoglideChecksum)
include(sonoglideBoard)

sonoglide_room(sonoglide_lockstep hal/lockstep USES sonoglide_hal)
sonoglide_room(sonoglide_start hal/start)
sonoglide_room(sonoglide_carrier_image firmware/image/carrier USES sonoglide_control)
sonoglide_room(sonoglide_image_plant firmware/image/plant
  USES sonoglide_strang sonoglide_hal sonoglide_start)

# sonoglide_image(<target> SOURCE <main> FOLDER <configuration> MEMORY <linker script>
#   USES <rooms>...): an image of one configured controller.
function(sonoglide_image target)
  cmake_parse_arguments(IMAGE "" "SOURCE;FOLDER;MEMORY" "USES" ${ARGN})
  set(script "${PROJECT_SOURCE_DIR}/${IMAGE_MEMORY}")
  add_executable(${target} "${PROJECT_SOURCE_DIR}/${IMAGE_SOURCE}")
  target_include_directories(${target} PRIVATE "${IMAGE_FOLDER}")
  target_link_libraries(${target} PRIVATE
    sonoglide_app ${IMAGE_USES} sonoglide_freestanding sonoglide_warnings)
  target_link_options(${target} PRIVATE "-L${PROJECT_SOURCE_DIR}" "-T${script}")
  set_target_properties(${target} PROPERTIES
    LINK_DEPENDS "${script};${PROJECT_SOURCE_DIR}/hal/start/loaded_sections.ld")
endfunction()

# sonoglide_images(<suffix> SOURCE <main> CLASS <board> HEADER <its header> MEMORY <linker script>
#   USES <rooms>...): an image of every configured controller on a class that has the shape which
# <main> asks for.
function(sonoglide_images suffix)
  cmake_parse_arguments(IMAGE "" "SOURCE;CLASS;HEADER;MEMORY" "USES" ${ARGN})
  foreach(folder IN LISTS SONOGLIDE_CONTROLLERS)
    get_filename_component(name "${folder}" NAME)
    sonoglide_image(${name}${suffix} SOURCE ${IMAGE_SOURCE} FOLDER "${folder}"
      MEMORY ${IMAGE_MEMORY} USES ${IMAGE_USES})
    target_compile_definitions(${name}${suffix} PRIVATE
      "SONOGLIDE_BOARD_CLASS=sonoglide::hal::${IMAGE_CLASS}"
      "SONOGLIDE_BOARD_HEADER=\"${IMAGE_HEADER}\""
      "SONOGLIDE_BOARD_NAME=\"${SONOGLIDE_BOARD}\"")
  endforeach()
endfunction()

# sonoglide_plant_images(<linker script>): an image of every controller that was configured with its
# plant, the two of them in one processor.
function(sonoglide_plant_images memory)
  foreach(folder IN LISTS SONOGLIDE_CONTROLLERS)
    if(EXISTS "${folder}/plant_configuration.hpp")
      get_filename_component(name "${folder}" NAME)
      sonoglide_image(${name}_plant SOURCE firmware/image/plant_main.cpp FOLDER "${folder}" MEMORY ${memory}
        USES sonoglide_image_plant sonoglide_processor sonoglide_semihosting)
    endif()
  endforeach()
endfunction()

# sonoglide_interrupts(<number>): that the board has, beside the exceptions of its Cortex-M. Of one that does not say,
# an image with handlers has as many vectors as the architecture allows (hal/cortex_m/interrupts.hpp).
function(sonoglide_interrupts number)
  if(number)
    target_compile_definitions(sonoglide_processor PUBLIC SONOGLIDE_INTERRUPTS=${number})
  endif()
endfunction()

# sonoglide_register(<function>): the board ${name} of that function.
function(sonoglide_register function)
  get_property(boards GLOBAL PROPERTY SONOGLIDE_BOARDS)
  if(name IN_LIST boards)
    message(FATAL_ERROR "${function}(${name}): there is a board ${name} already")
  endif()
  set_property(GLOBAL APPEND PROPERTY SONOGLIDE_BOARDS ${name})
endfunction()

# sonoglide_check_board(<function> <linker script> CLASSES <keywords>... [OTHERS <keywords>...]): what a person wrote of
# the board ${name} of that function, which has parsed its arguments as BOARD_...; CLASSES are of board.hpp, OTHERS are
# allowed besides.
function(sonoglide_check_board function memory)
  cmake_parse_arguments(CHECK "" "" "CLASSES;OTHERS" ${ARGN})
  set(call "${function}(${name})")
  set(keywords FOLDER ${CHECK_CLASSES} ${CHECK_OTHERS} INTERRUPTS)
  list(REMOVE_DUPLICATES keywords)
  sonoglide_require_board_arguments("${call}" "${name}" ${keywords})
  if(NOT BOARD_FOLDER)
    message(FATAL_ERROR "${call}: FOLDER is missing")
  endif()
  foreach(file "${BOARD_FOLDER}/board.hpp" "${memory}")
    if(NOT EXISTS "${PROJECT_SOURCE_DIR}/${file}")
      message(FATAL_ERROR "${call}: there is no ${file}")
    endif()
  endforeach()
  foreach(argument IN LISTS CHECK_CLASSES)
    sonoglide_require_class("${call}" ${argument} "${BOARD_${argument}}"
      "${PROJECT_SOURCE_DIR}/${BOARD_FOLDER}/board.hpp")
  endforeach()
endfunction()

# sonoglide_board(<name> FOLDER <f> CLASS <c> [INTERRUPTS <number>]): a board that keeps its own carrier periods. Its
# class is in <f>/board.hpp, its memory map in <f>/memory.ld.
function(sonoglide_board name)
  sonoglide_register(sonoglide_board)
  if(NOT name STREQUAL SONOGLIDE_BOARD)
    return()
  endif()
  cmake_parse_arguments(BOARD "" "FOLDER;CLASS;INTERRUPTS" "" ${ARGN})
  sonoglide_check_board(sonoglide_board ${BOARD_FOLDER}/memory.ld CLASSES CLASS)
  sonoglide_interrupts("${BOARD_INTERRUPTS}")
  sonoglide_room(sonoglide_board ${BOARD_FOLDER} USES sonoglide_hal sonoglide_start)
  sonoglide_images("" SOURCE firmware/image/main.cpp MEMORY ${BOARD_FOLDER}/memory.ld
    CLASS ${BOARD_CLASS} HEADER ${BOARD_FOLDER}/board.hpp
    USES sonoglide_board sonoglide_processor)
endfunction()

# sonoglide_carrier_board(<name> FOLDER <f> [CHIP <chip>] HARDWARE <class>
#   SERIAL_BOARD <class> [INTERRUPTS <number>] [ENCODER]): a board whose carrier interrupts. Its
# class is in <f>/board.hpp, its memory map in <f>/memory.ld; of boards that differ in their chip alone, what is
# the chip's own is in <f>/<chip>. Each controller gives <name of its folder>_unit.elf, with
# a link to its host, and <name>_scene.elf, with the targets of its scene, and <name>_serial.elf, in lockstep with a
# host over a serial line (SERIAL_BOARD). <f>/write_uf2 writes a .uf2 beside each, where there is such a program, and Python.
# ENCODER: it reads one along the sliding where SONOGLIDE_ENCODER_COUNTS_PER_M says its resolution.
function(sonoglide_carrier_board name)
  sonoglide_register(sonoglide_carrier_board)
  if(NOT name STREQUAL SONOGLIDE_BOARD)
    return()
  endif()
  cmake_parse_arguments(BOARD "ENCODER" "FOLDER;CHIP;HARDWARE;SERIAL_BOARD;INTERRUPTS" "" ${ARGN})
  set(memory ${BOARD_FOLDER}/memory.ld)
  if(BOARD_CHIP)
    set(memory ${BOARD_FOLDER}/${BOARD_CHIP}/memory.ld)
  endif()
  sonoglide_check_board(sonoglide_carrier_board ${memory} CLASSES HARDWARE SERIAL_BOARD OTHERS CHIP ENCODER)
  sonoglide_interrupts("${BOARD_INTERRUPTS}")
  sonoglide_room(sonoglide_board ${BOARD_FOLDER} FOLDERS ${BOARD_CHIP} USES sonoglide_lockstep_board sonoglide_loaded)
  if(BOARD_CHIP)
    target_compile_definitions(sonoglide_board PUBLIC
      "SONOGLIDE_CHIP_HEADER=\"${BOARD_FOLDER}/${BOARD_CHIP}/chip.hpp\"")
  endif()
  if(BOARD_ENCODER AND SONOGLIDE_ENCODER_COUNTS_PER_M)
    target_compile_definitions(sonoglide_board PUBLIC
      SONOGLIDE_ENCODER_COUNTS_PER_M=${SONOGLIDE_ENCODER_COUNTS_PER_M})
  endif()
  set_property(GLOBAL PROPERTY SONOGLIDE_BOARD_READS_ENCODER ${BOARD_ENCODER})
  find_program(SONOGLIDE_INTERPRETER python3)
  set(class_of_serial ${BOARD_SERIAL_BOARD})
  set(main_of_serial firmware/image/main.cpp)
  foreach(image unit scene)
    set(class_of_${image} ${BOARD_HARDWARE})
    set(main_of_${image} firmware/image/carrier_${image}.cpp)
  endforeach()
  set(images unit scene serial)
  # Of the tests, which a tree of the product alone does not have: built by its name alone.
  set(main_of_begun tests/boards/begun_start.cpp)
  set(class_of_begun ${BOARD_HARDWARE})
  if(EXISTS "${PROJECT_SOURCE_DIR}/${main_of_begun}")
    list(APPEND images begun)
  endif()
  foreach(image IN LISTS images)
    sonoglide_images(_${image} SOURCE ${main_of_${image}}
      MEMORY ${memory} CLASS ${class_of_${image}} HEADER ${BOARD_FOLDER}/board.hpp
      USES sonoglide_carrier_image sonoglide_board)
    foreach(folder IN LISTS SONOGLIDE_CONTROLLERS)
      get_filename_component(controller "${folder}" NAME)
      set(target ${controller}_${image})
      if(image STREQUAL begun)
        set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL ON)
      elseif(image STREQUAL unit)
        sonoglide_image_checksum(${target})
      endif()
      # Measured: 8 % fewer clocks in a carrier period on a Cortex-M0+, 4 to 8 % fewer instructions on an M4F.
      target_compile_options(${target} PRIVATE
        -O3 -fira-algorithm=priority -frename-registers -fno-tree-vrp -fno-tree-pre -fno-split-wide-types -fno-ivopts -fno-reorder-blocks -fno-tree-sink)
      if(SONOGLIDE_INTERPRETER AND EXISTS "${PROJECT_SOURCE_DIR}/${BOARD_FOLDER}/write_uf2")
        add_custom_command(TARGET ${target} POST_BUILD VERBATIM
          COMMAND "${SONOGLIDE_INTERPRETER}" "${PROJECT_SOURCE_DIR}/${BOARD_FOLDER}/write_uf2"
            "$<TARGET_FILE:${target}>" ${BOARD_CHIP})
      endif()
    endforeach()
  endforeach()
endfunction()

# sonoglide_emulated_board(<name> FOLDER <f> [MEMORY <its linker script>] SERIAL_BOARD <class>
#   [TIMED_HARDWARE <class>] [INTERRUPTS <number>]): a board in lockstep with its host, over semihosting and over a serial
# line, and on its own timer. The classes are in <f>/board.hpp.
function(sonoglide_emulated_board name)
  sonoglide_register(sonoglide_emulated_board)
  if(NOT name STREQUAL SONOGLIDE_BOARD)
    return()
  endif()
  cmake_parse_arguments(BOARD "" "FOLDER;MEMORY;SERIAL_BOARD;TIMED_HARDWARE;INTERRUPTS" "" ${ARGN})
  if(NOT BOARD_MEMORY)
    set(BOARD_MEMORY memory.ld)
  endif()
  set(classes SERIAL_BOARD)
  if(BOARD_TIMED_HARDWARE)
    list(APPEND classes TIMED_HARDWARE)
  endif()
  sonoglide_check_board(sonoglide_emulated_board ${BOARD_FOLDER}/${BOARD_MEMORY}
    CLASSES ${classes} OTHERS MEMORY TIMED_HARDWARE)
  sonoglide_interrupts("${BOARD_INTERRUPTS}")
  sonoglide_room(sonoglide_emulated_board ${BOARD_FOLDER}
    USES sonoglide_lockstep_board sonoglide_timed sonoglide_processor)
  sonoglide_images("" SOURCE firmware/image/main.cpp MEMORY ${BOARD_FOLDER}/${BOARD_MEMORY}
    CLASS semihosting::SemihostingBoard HEADER hal/semihosting/semihosting_board.hpp
    USES sonoglide_processor sonoglide_semihosting)
  sonoglide_images(_serial SOURCE firmware/image/main.cpp MEMORY ${BOARD_FOLDER}/${BOARD_MEMORY}
    CLASS ${BOARD_SERIAL_BOARD} HEADER ${BOARD_FOLDER}/board.hpp
    USES sonoglide_emulated_board sonoglide_semihosting)
  # By its name alone: what a unit takes, which an image of the unit itself does not tell.
  sonoglide_images(_counted SOURCE firmware/image/counted_unit.cpp MEMORY ${BOARD_FOLDER}/${BOARD_MEMORY}
    CLASS semihosting::SemihostingBoard HEADER hal/semihosting/semihosting_board.hpp
    USES sonoglide_timed sonoglide_processor sonoglide_semihosting)
  foreach(folder IN LISTS SONOGLIDE_CONTROLLERS)
    get_filename_component(controller "${folder}" NAME)
    set_target_properties(${controller}_counted PROPERTIES EXCLUDE_FROM_ALL ON)
  endforeach()
  if(BOARD_TIMED_HARDWARE)
    set(timed_main firmware/image/timed_unit.cpp)
    set(timed_images timed)
    # Of the tests, which a tree of the product alone does not have: built by their names alone, because some
    # need what the tests record.
    set(exception_main tests/boards/exception_unit.cpp)
    set(begun_main tests/boards/begun_start.cpp)
    set(interrupted_main tests/boards/interrupted_unit.cpp)
    set(replayed_main tests/boards/replayed_run.cpp)
    set(hung_main tests/boards/hung_service.cpp)
    set(vectored_main tests/boards/vectored_start.cpp)
    if(EXISTS "${PROJECT_SOURCE_DIR}/${exception_main}")
      list(APPEND timed_images exception begun replayed)
      if(CMAKE_SYSTEM_PROCESSOR STREQUAL arm)
        list(APPEND timed_images interrupted hung vectored)
      endif()
    endif()
    foreach(image IN LISTS timed_images)
      sonoglide_images(_${image} SOURCE ${${image}_main} MEMORY ${BOARD_FOLDER}/${BOARD_MEMORY}
        CLASS ${BOARD_TIMED_HARDWARE} HEADER ${BOARD_FOLDER}/board.hpp
        USES sonoglide_emulated_board sonoglide_halt)
      foreach(folder IN LISTS SONOGLIDE_CONTROLLERS)
        get_filename_component(controller "${folder}" NAME)
        if(image STREQUAL timed)
          sonoglide_image_checksum(${controller}_timed)
        else()
          set_target_properties(${controller}_${image} PROPERTIES EXCLUDE_FROM_ALL ON)
        endif()
      endforeach()
    endforeach()
  endif()
  sonoglide_plant_images(${BOARD_FOLDER}/${BOARD_MEMORY})
endfunction()

if(CMAKE_CROSSCOMPILING)
  set(SONOGLIDE_BOARD "" CACHE STRING "Board that images are linked for")
  set(SONOGLIDE_CONTROLLERS "" CACHE STRING
    "Folders with a controller_configuration.hpp; each gives images of its name")
  set(SONOGLIDE_ENCODER_COUNTS_PER_M "" CACHE STRING
    "Counts of the encoder along the sliding in a metre, for images of scenes with a texture; empty: there is none")

  set(folders "")
  set(names "")
  foreach(folder IN LISTS SONOGLIDE_CONTROLLERS)
    get_filename_component(folder "${folder}" ABSOLUTE)
    get_filename_component(name "${folder}" NAME)
    if(NOT EXISTS "${folder}/controller_configuration.hpp")
      message(FATAL_ERROR "SONOGLIDE_CONTROLLERS: ${folder} has no controller_configuration.hpp: "
        "sonoglide configure SCENE --out ${folder} writes it")
    elseif(name IN_LIST names)
      message(FATAL_ERROR "SONOGLIDE_CONTROLLERS: two folders are called ${name}, and so would be their images")
    endif()
    list(APPEND folders "${folder}")
    list(APPEND names "${name}")
  endforeach()
  set(SONOGLIDE_CONTROLLERS ${folders})  # whole, without a slash at the end

  sonoglide_room(sonoglide_lockstep_board hal/lockstep/board
    USES sonoglide_lockstep sonoglide_start)
  sonoglide_room(sonoglide_semihosting hal/semihosting USES sonoglide_lockstep_board)
  sonoglide_room(sonoglide_halt hal/halt USES sonoglide_start sonoglide_timed)
  # In the images that name it alone.
  sonoglide_room(sonoglide_exception hal/exception USES sonoglide_hal sonoglide_start)
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL arm)
    sonoglide_room(sonoglide_processor hal/cortex_m USES sonoglide_start sonoglide_exception)
    sonoglide_room(sonoglide_loaded hal/cortex_m/loaded USES sonoglide_processor)
  else()
    sonoglide_room(sonoglide_processor hal/riscv USES sonoglide_start sonoglide_exception)
  endif()

  sonoglide_board(template FOLDER hal/template CLASS template_board::Board)
  sonoglide_carrier_board(pico FOLDER hal/pico CHIP rp2040 HARDWARE pico::Hardware SERIAL_BOARD pico::SerialBoard)
  sonoglide_carrier_board(pico2 FOLDER hal/pico CHIP rp2350 HARDWARE pico::Hardware SERIAL_BOARD pico::SerialBoard
    INTERRUPTS 52)
  sonoglide_carrier_board(nucleo-g474re FOLDER hal/nucleo_g474re HARDWARE nucleo_g474re::Hardware
    SERIAL_BOARD nucleo_g474re::SerialBoard INTERRUPTS 102 ENCODER)
  sonoglide_emulated_board(microbit FOLDER hal/microbit
    SERIAL_BOARD microbit::SerialBoard TIMED_HARDWARE microbit::TimedHardware)
  foreach(board mps2-an385 mps2-an386 mps2-an500)
    sonoglide_emulated_board(${board} FOLDER hal/mps2
      SERIAL_BOARD mps2::An385SerialBoard TIMED_HARDWARE mps2::An385TimedHardware INTERRUPTS 32)
  endforeach()
  sonoglide_emulated_board(mps2-an505 FOLDER hal/mps2 MEMORY an505_memory.ld
    SERIAL_BOARD mps2::An505SerialBoard TIMED_HARDWARE mps2::An505TimedHardware INTERRUPTS 124)
  sonoglide_emulated_board(netduinoplus2 FOLDER hal/netduinoplus2
    SERIAL_BOARD netduinoplus2::SerialBoard TIMED_HARDWARE netduinoplus2::TimedHardware INTERRUPTS 82)
  sonoglide_emulated_board(riscv32-virt FOLDER hal/riscv_virt
    SERIAL_BOARD riscv_virt::SerialBoard TIMED_HARDWARE riscv_virt::TimedHardware)

  get_property(boards GLOBAL PROPERTY SONOGLIDE_BOARDS)
  if(SONOGLIDE_BOARD AND NOT SONOGLIDE_BOARD IN_LIST boards)
    list(JOIN boards ", " boards)
    message(FATAL_ERROR "No board is called ${SONOGLIDE_BOARD}; there are ${boards}")
  elseif(SONOGLIDE_CONTROLLERS AND NOT SONOGLIDE_BOARD)
    message(FATAL_ERROR "An image is for a board: set SONOGLIDE_BOARD, or use the board's preset")
  endif()
  if(NOT SONOGLIDE_ENCODER_COUNTS_PER_M STREQUAL "")
    set(named "SONOGLIDE_ENCODER_COUNTS_PER_M=${SONOGLIDE_ENCODER_COUNTS_PER_M}")
    get_property(reads GLOBAL PROPERTY SONOGLIDE_BOARD_READS_ENCODER)
    if(NOT reads)
      message(FATAL_ERROR "${named}: ${SONOGLIDE_BOARD} reads no encoder; allowed: the board nucleo-g474re, or leave it out")
    elseif(NOT SONOGLIDE_ENCODER_COUNTS_PER_M MATCHES "^[1-9][0-9]*(\\.[0-9]+)?(e[0-9]+)?$")
      message(FATAL_ERROR "${named}; allowed: a number of 1 or more, such as 1e6")
    endif()
  endif()
endif()
