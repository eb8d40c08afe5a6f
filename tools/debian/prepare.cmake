# What a Debian package holds that is made by the program itself: a manual page a command, the shells'
# completions; and the package's change log.
# -DPROGRAM= -DHELP2MAN= -DVERSION= -DSOURCE= -DFOLDER=

function(run)
  execute_process(COMMAND ${ARGV} OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
  set(printed "${printed}" PARENT_SCOPE)
endfunction()

# manual(<words of a command>...): its page, and those of the commands inside it.
function(manual)
  run("${PROGRAM}" ${ARGV} --help)
  set(help "${printed}")
  string(REGEX MATCH "^[^\n]*" purpose "${help}")
  string(REPLACE ";" "," purpose "${purpose}")
  string(JOIN "-" page sonoglide ${ARGV})
  # A program of the page's name: so the manual calls it.
  list(JOIN ARGV " " words)
  file(WRITE "${FOLDER}/commands/${page}" "#!/bin/sh\nexec '${PROGRAM}' ${words} \"$@\"\n")
  file(CHMOD "${FOLDER}/commands/${page}" PERMISSIONS OWNER_READ OWNER_EXECUTE)
  run("${HELP2MAN}" --no-info --section=1 "--name=${purpose}" "--version-string=${VERSION}"
    --source=Sonoglide --manual=Sonoglide "--output=${FOLDER}/man/${page}.1"
    "${FOLDER}/commands/${page}")
  run(gzip -9n "${FOLDER}/man/${page}.1")
  string(REGEX REPLACE "^.*\nSubcommands:\n" "" commands "${help}")
  if(NOT commands STREQUAL help)
    string(REGEX MATCHALL "\n  [a-z][a-z-]*" commands "\n${commands}")
    foreach(command IN LISTS commands)
      string(STRIP "${command}" command)
      manual(${ARGV} ${command})
    endforeach()
  endif()
endfunction()

file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}/man")
manual()
foreach(pair bash:sonoglide zsh:_sonoglide fish:sonoglide.fish)
  string(REPLACE ":" ";" pair "${pair}")
  list(POP_FRONT pair shell name)
  run("${PROGRAM}" completion ${shell})
  file(WRITE "${FOLDER}/${name}" "${printed}")
endforeach()
configure_file("${SOURCE}/tools/debian/changelog.in" "${FOLDER}/changelog" @ONLY)
run(gzip -9n "${FOLDER}/changelog")
