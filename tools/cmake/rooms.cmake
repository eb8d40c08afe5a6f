# A room is one folder with one purpose. Its target sees, under the include
# root, its own folder and those of the rooms it links, and nothing else: an
# include against the arrows does not find its file.

# sonoglide_room(<target> <folder> [FOLDERS <folders>...] [USES <rooms>...] [LIBRARIES <libraries>...])
#
# FOLDERS are those inside this one whose files belong to the room.
function(sonoglide_room target folder)
  cmake_parse_arguments(ROOM "" "" "FOLDERS;USES;LIBRARIES" ${ARGN})
  set(root "${PROJECT_BINARY_DIR}/sight/${target}")
  list(TRANSFORM ROOM_FOLDERS REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/${folder}/\\1/*.cpp"
    OUTPUT_VARIABLE inner)
  file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${folder}/*.cpp" ${inner})
  list(TRANSFORM inner REPLACE "cpp$" "hpp")
  file(GLOB names CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/${folder}"
    "${PROJECT_SOURCE_DIR}/${folder}/*.hpp" ${inner})
  # Header by header: any other folder inside this one is another room.
  foreach(inside "" ${ROOM_FOLDERS})
    file(MAKE_DIRECTORY "${root}/${folder}/${inside}")
  endforeach()
  set(headers "")
  foreach(name IN LISTS names)
    file(CREATE_LINK "${PROJECT_SOURCE_DIR}/${folder}/${name}" "${root}/${folder}/${name}"
      COPY_ON_ERROR SYMBOLIC)  # Windows allows links to few
    list(APPEND headers "${root}/${folder}/${name}")
  endforeach()

  if(sources)
    add_library(${target} STATIC ${sources})
    sonoglide_unite(${target})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE sonoglide_warnings)
    if(folder MATCHES "^tests/")
      sonoglide_optimise(-O0 ${target})
    endif()
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  set_target_properties(${target} PROPERTIES
    SONOGLIDE_FOLDER "${folder}" SONOGLIDE_USES "${ROOM_USES}")
  set_property(GLOBAL APPEND PROPERTY SONOGLIDE_ROOMS ${target})
  # Links into the source tree: the headers that are installed are those behind them.
  target_include_directories(${target} ${scope} "$<BUILD_INTERFACE:${root}>")
  target_link_libraries(${target} ${scope} sonoglide_language ${ROOM_USES} ${ROOM_LIBRARIES})
  if(PROJECT_IS_TOP_LEVEL AND NOT sources AND NOT SONOGLIDE_SANITIZE)
    sonoglide_check_headers(${target} "${folder}" "${headers}")
  endif()
endfunction()

# With SONOGLIDE_UNITE a room is one translation unit: what it includes is then compiled, and looked
# through by clang-tidy, once. From nothing the program so takes about half the time.
function(sonoglide_unite target)
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD ${SONOGLIDE_UNITE} UNITY_BUILD_BATCH_SIZE 0
    UNITY_BUILD_CODE_BEFORE_INCLUDE "// NOLINTNEXTLINE(bugprone-suspicious-include)")
endfunction()

# sonoglide_optimise(<-O1 or -O2> <rooms>...): rooms that gain nothing from -O3, in which the solvers
# are twice as fast, and with which a room takes half as long again to compile. The sanitizers have those
# that compute, -O2 here, in -O1, and all else in -O0.
function(sonoglide_optimise level)
  foreach(target IN LISTS ARGN)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${level}>)
    if(level STREQUAL "-O2")
      sonoglide_optimise_sanitized(${target})
    endif()
  endforeach()
endfunction()

# sonoglide_optimise_sanitized(<rooms>...): compute for longer at -O0 than they take to compile so. Clang's
# -O1 alone inlines nothing.
function(sonoglide_optimise_sanitized)
  if(SONOGLIDE_SANITIZE)
    foreach(target IN LISTS ARGN)
      target_compile_options(${target} PRIVATE -O1 -finline-functions)
    endforeach()
  endif()
endfunction()

# Compiles every header of a room without sources alone, with nothing in sight
# but the room's own arrows: it is held to them too.
function(sonoglide_check_headers target folder headers)
  set(checks "")
  foreach(header IN LISTS headers)
    get_filename_component(name "${header}" NAME_WE)
    set(check "${PROJECT_BINARY_DIR}/header_checks/${target}/${name}.cpp")
    set(text "#include \"${folder}/${name}.hpp\"\n")
    file(CONFIGURE OUTPUT "${check}" CONTENT "${text}" @ONLY)
    list(APPEND checks "${check}")
  endforeach()
  if(checks)
    add_library(${target}_headers OBJECT ${checks})
    if(NOT SONOGLIDE_CHECK)
      set_target_properties(${target}_headers PROPERTIES EXCLUDE_FROM_ALL ON)
    endif()
    target_link_libraries(${target}_headers PRIVATE ${target} sonoglide_warnings)
    if(NOT folder MATCHES "^tests/")
      target_link_libraries(${target}_headers PRIVATE sonoglide_freestanding)
    endif()
  endif()
endfunction()

# sonoglide_joint_tests(<program>): the program of the tests that are added from here on, in this folder and
# those inside. What they include is compiled once for some thirty files, not once a test: a third of the
# time. It runs those of a test alone, by the files that hold them.
function(sonoglide_joint_tests program)
  add_executable(${program} "${PROJECT_SOURCE_DIR}/tests/joint_main.cpp")
  target_link_libraries(${program} PRIVATE sonoglide_warnings GTest::gtest)
  sonoglide_compile_test(${program})
  set_target_properties(${program} PROPERTIES UNITY_BUILD_BATCH_SIZE 30)
  set(SONOGLIDE_JOINT_TESTS ${program} PARENT_SCOPE)
endfunction()

function(sonoglide_compile_test program)
  sonoglide_optimise(-O0 ${program})
  target_precompile_headers(${program} REUSE_FROM sonoglide_test_headers)
  sonoglide_unite(${program})
endfunction()

# sonoglide_test(<name> [ALONE] [OPTIMISED] [CHECK] SOURCES <files>... USES <targets>...
#   [DEFINES <definitions>...] [CHECKED <tests>...] [LONG <tests>...]): tests of GoogleTest. For ctest they
# are one test, so that a suite computes once what its tests look at. They are a program of their own where
# they are ALONE, OPTIMISED or a CHECK, or no joint one is there. OPTIMISED ones would compute for longer at
# -O0 than they take to compile at -O1. A CHECK is left to tools/check, and so are CHECKED tests of another.
# The sanitizers leave out LONG tests, which compute for minutes under them on paths that others take, and
# CHECKED ones.
function(sonoglide_test name)
  cmake_parse_arguments(TEST "ALONE;OPTIMISED;CHECK" "" "SOURCES;USES;DEFINES;CHECKED;LONG" ${ARGN})
  set(left_out OFF)
  if((SONOGLIDE_SANITIZE AND TEST_LONG STREQUAL "*")
      OR (TEST_CHECK AND NOT SONOGLIDE_CHECK AND NOT SONOGLIDE_SANITIZE))
    set(left_out ON)
  endif()
  if(SONOGLIDE_JOINT_TESTS AND NOT TEST_ALONE AND NOT TEST_OPTIMISED AND NOT TEST_CHECK)
    if(left_out)
      return()
    endif()
    set(program ${SONOGLIDE_JOINT_TESTS})
    list(TRANSFORM TEST_SOURCES PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/")
    target_sources(${program} PRIVATE ${TEST_SOURCES})
    list(JOIN TEST_SOURCES ":" files)
    set(files "--files=${files}")
    add_custom_target(${name} ALL)
    add_dependencies(${name} ${program})
  else()
    set(program ${name})
    set(files "")
    add_executable(${name} ${TEST_SOURCES})
    target_link_libraries(${name} PRIVATE sonoglide_warnings GTest::gtest_main)
    if(TEST_OPTIMISED)
      sonoglide_optimise(-O1 ${name})
      sonoglide_optimise_sanitized(${name})
      sonoglide_unite(${name})
    else()
      sonoglide_compile_test(${name})
    endif()
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ${left_out})
  endif()
  target_link_libraries(${program} PRIVATE ${TEST_USES})
  target_compile_definitions(${program} PRIVATE ${TEST_DEFINES})
  if(left_out)
    return()
  endif()
  if(NOT SONOGLIDE_SANITIZE)
    set(TEST_LONG "")
  endif()
  list(JOIN TEST_CHECKED ":" checked)
  list(JOIN TEST_LONG ":" long)
  add_test(NAME ${name} COMMAND ${program} ${files} --gtest_brief=1 "--gtest_filter=-${checked}:${long}")
  if(TEST_CHECK)
    set_tests_properties(${name} PROPERTIES LABELS check)
  endif()
  if(TEST_CHECKED AND SONOGLIDE_CHECK)
    add_test(NAME ${name}.checked
      COMMAND ${program} ${files} --gtest_brief=1 "--gtest_filter=${checked}")
    set_tests_properties(${name}.checked PROPERTIES LABELS check)
  endif()
endfunction()
