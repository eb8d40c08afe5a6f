# Installs the package and copies the stranger's project, with a controller that the installed program
# configures, beside it. Then nothing in the package is a link or names the source tree.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

file(REMOVE_RECURSE "${FOLDER}/installed" "${FOLDER}/prefix" "${FOLDER}/stranger" "${FOLDER}/above"
  "${FOLDER}/own_board")
foreach(component core documents program)
  run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${FOLDER}/installed" --component ${component})
endforeach()
file(RENAME "${FOLDER}/installed" "${FOLDER}/prefix")
set(data "${FOLDER}/prefix/share/sonoglide")

file(COPY "${CMAKE_CURRENT_LIST_DIR}/stranger" "${CMAKE_CURRENT_LIST_DIR}/above"
    "${CMAKE_CURRENT_LIST_DIR}/own_board"
  DESTINATION "${FOLDER}")
foreach(project stranger own_board)
  file(COPY "${data}/hal/template" DESTINATION "${FOLDER}/${project}/hal")
  run("${FOLDER}/prefix/bin/sonoglide" configure "${data}/scenes/target_step.toml"
    --out "${FOLDER}/${project}/controller")
endforeach()

# The program names the tree that it builds images from; nothing else does. A scene names the place of
# the schema that it is judged by.
set(schema "share/sonoglide/scenes/scene.schema.json")
file(GLOB_RECURSE files LIST_DIRECTORIES ON
  "${FOLDER}/prefix/include/*" "${FOLDER}/prefix/share/*")
foreach(file IN LISTS files)
  if(IS_SYMLINK "${file}")
    message(FATAL_ERROR "${file} is a link")
  elseif(NOT IS_DIRECTORY "${file}")
    file(READ "${file}" text)
    if(file MATCHES "/share/sonoglide/scenes/[a-z_0-9]*[.]toml$")
      set(named "#:schema ${FOLDER}/installed/${schema}\n")
      expect("${text}" HAS "${named}")
      string(REPLACE "${named}" "" text "${text}")
    endif()
    foreach(folder "${SOURCE}" "${FOLDER}")
      string(FIND "${text}" "${folder}" at)
      if(NOT at EQUAL -1)
        message(FATAL_ERROR "${file} names ${folder}")
      endif()
    endforeach()
  endif()
endforeach()
foreach(file include/sonoglide/firmware/control/controller.hpp ${schema} share/sonoglide/hal/template/memory.ld
    share/sonoglide/toolchains/arm-cortex-m4f.cmake share/doc/sonoglide/LICENSE
    share/doc/sonoglide/README.md share/doc/sonoglide/firmware/README.md)
  if(NOT EXISTS "${FOLDER}/prefix/${file}")
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
