# What a Debian package holds that is made by the program itself: a manual page a command, the shells'
# completions; and the package's change log.
# -DPROGRAM= -DHELP2MAN= -DVERSION= -DSOURCE= -DFOLDER=

function(run)
  execute_process(COMMAND ${ARGV} OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
  set(printed "${printed}" PARENT_SCOPE)
endfunction()

set(SCENES /usr/share/sonoglide/scenes)
set(DOCUMENTS /usr/share/doc/sonoglide)
include("${CMAKE_CURRENT_LIST_DIR}/examples.cmake")

# verbatim(<variable> <text>): the text as a manual page takes it.
function(verbatim variable text)
  string(REPLACE "\\" "\\e" text "${text}")
  string(REPLACE "-" "\\-" text "${text}")
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

# write_sections(<page> <help>): what a page has beside the help text, for help2man to include.
function(write_sections page help)
  set(text "[exit status]\n")
  set(meanings
    "done, also if the controller ends in a fault or misses its target"
    "the file system or another program failed"
    "bad usage or bad scene, of which the message names file, line and key. No file was written"
    "the computation failed. The message gives the time, the state and the reason")
  foreach(code RANGE 3)
    list(GET meanings ${code} meaning)
    string(APPEND text ".TP\n.B ${code}\n${meaning}\n")
  endforeach()

  string(APPEND text "[files]\n.nh\n.ad l\n")
  if("${help}" MATCHES "--out DIR +Folder for ([^[]+) \\[([^];]+)")
    set(files "${CMAKE_MATCH_1}")
    verbatim(folder "${CMAKE_MATCH_2}")
    verbatim(files "${files}")
    string(APPEND text ".TP\n.I ${folder}\nwithout \\-\\-out: ${files}\n")
  endif()
  string(APPEND text
    ".TP\n.I ${SCENES}\nexample scenes\n"
    ".TP\n.I ${DOCUMENTS}/host_sim/files.md\nevery key and column of the files that are written\n")

  string(APPEND text "[examples]\n")
  set(examples ${examples_${page}})
  if(NOT examples)
    message(FATAL_ERROR "examples.cmake has no examples_${page}")
  endif()
  list(LENGTH examples size)
  math(EXPR odd "${size} % 2")
  if(odd)
    message(FATAL_ERROR "examples_${page} are no pairs: a semicolon separates two of them")
  endif()
  while(examples)
    list(POP_FRONT examples command purpose)
    verbatim(command "${command}")
    string(REPLACE "/" "/\\:" command "${command}")  # a long path may go on in the next line
    string(APPEND text ".TP\n.B ${command}\n${purpose}\n")
  endwhile()

  string(APPEND text "[see also]\n")
  set(others sonoglide ${see_also})
  list(REMOVE_ITEM others ${page})
  foreach(other IN LISTS others)
    verbatim(other "${other}")
    string(APPEND text ".BR ${other} (1),\n")
  endforeach()
  string(APPEND text ".I ${DOCUMENTS}/README.md\n")
  file(WRITE "${FOLDER}/sections/${page}" "${text}")
endfunction()

# manual(<words of a command>...): its page, and those of the commands inside it.
function(manual)
  run("${PROGRAM}" ${ARGV} --help)
  set(help "${printed}")
  string(REGEX MATCH "^[^\n;]*" purpose "${help}")
  string(JOIN "-" page sonoglide ${ARGV})
  # A program of the page's name: so the manual calls it.
  list(JOIN ARGV " " words)
  file(WRITE "${FOLDER}/commands/${page}" "#!/bin/sh\nexec '${PROGRAM}' ${words} \"$@\"\n")
  file(CHMOD "${FOLDER}/commands/${page}" PERMISSIONS OWNER_READ OWNER_EXECUTE)
  set(inner "")
  string(REGEX REPLACE "^.*\nSubcommands:\n" "" commands "${help}")
  if(NOT commands STREQUAL help)
    string(REGEX MATCHALL "\n  [a-z][a-z-]*" inner "\n${commands}")
    list(TRANSFORM inner STRIP)
  endif()
  if(inner)
    list(TRANSFORM inner PREPEND "${page}-" OUTPUT_VARIABLE see_also)
  endif()
  write_sections(${page} "${help}")
  run("${HELP2MAN}" --no-info --section=1 "--include=${FOLDER}/sections/${page}"
    "--name=${purpose}" "--version-string=${VERSION}" --source=Sonoglide --manual=Sonoglide "--output=${FOLDER}/man/${page}.1"
    "${FOLDER}/commands/${page}")
  run(gzip -9n "${FOLDER}/man/${page}.1")
  foreach(command IN LISTS inner)
    manual(${ARGV} ${command})
  endforeach()
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
