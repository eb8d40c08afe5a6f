# The Debian packages: made, judged by lintian, unpacked and removed by dpkg in a root of their own, and
# used there. Their manual pages are silent under `man --warnings`, have every section and are found by
# their names; the examples in them run.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

set(root "${FOLDER}/debian_root")
file(REMOVE_RECURSE "${root}" "${FOLDER}/packages")
run("${CMAKE_COMMAND}" "-DPROGRAM=${BUILD}/bin/sonoglide" "-DHELP2MAN=${HELP2MAN}"
  "-DVERSION=${VERSION}" "-DSOURCE=${SOURCE}" "-DFOLDER=${BUILD}/debian"
  -P "${SOURCE}/tools/debian/prepare.cmake")
run("${CMAKE_CPACK_COMMAND}" --config "${BUILD}/CPackConfig.cmake" -B "${FOLDER}/packages")
file(GLOB packages "${FOLDER}/packages/*.deb")
list(LENGTH packages count)
set(names sonoglide libsonoglide-dev)
if(PYTHON)
  list(APPEND names python3-sonoglide)
endif()
list(LENGTH names expected)
if(NOT count EQUAL expected)
  message(FATAL_ERROR "Expected ${names}: ${packages}")
endif()
run(lintian --allow-root --fail-on error ${packages})

run("${BUILD}/bin/sonoglide" --help)
string(REGEX REPLACE "^.*\nSubcommands:\n" "" commands "${output}")
string(REGEX MATCHALL "\n  [a-z][a-z-]*" commands "\n${commands}")
foreach(command IN ITEMS "" ${commands})
  string(STRIP "${command}" command)
  string(JOIN "-" page sonoglide ${command})
  set(pages ${pages} "${page}.1.gz")
  run("${CMAKE_COMMAND}" -E env LC_ALL=C.UTF-8 MANROFFSEQ= MANWIDTH=80
    man --warnings --local-file --troff-device=utf8 --ditroff "${BUILD}/debian/man/${page}.1.gz")
  expect("${output}" HAS_NO "warning")
  expect("${output}" HAS "Sonoglide")
  run(zcat "${BUILD}/debian/man/${page}.1.gz")
  foreach(section NAME SYNOPSIS DESCRIPTION OPTIONS [["EXIT STATUS"]] FILES EXAMPLES [["SEE ALSO"]])
    expect("${output}" HAS "\n.SH ${section}\n")
  endforeach()
  run(lexgrog "${BUILD}/debian/man/${page}.1.gz")
  expect("${output}" HAS "${page} - ")
endforeach()

# dpkg as it is on a machine that has nothing: what the packages depend on is looked up on this one.
file(MAKE_DIRECTORY "${root}/var/lib/dpkg/updates" "${root}/var/lib/dpkg/info")
file(WRITE "${root}/var/lib/dpkg/status" "")
set(dpkg dpkg "--root=${root}" --force-depends --force-not-root --force-script-chrootless)
run(${dpkg} --install ${packages})
foreach(page IN LISTS pages)
  if(NOT EXISTS "${root}/usr/share/man/man1/${page}")
    message(FATAL_ERROR "${page} is not installed")
  endif()
endforeach()
file(STRINGS "${root}/usr/share/sonoglide/scenes/target_step.toml" lines LIMIT_COUNT 1)
expect("${lines}" HAS "#:schema /usr/share/sonoglide/scenes/scene.schema.json")
run("${root}/usr/bin/sonoglide" run "${root}/usr/share/sonoglide/scenes/target_step.toml"
  --out "${FOLDER}/debian_run")
expect("${output}" HAS "0.600")
set(SCENES "${root}/usr/share/sonoglide/scenes")
set(DOCUMENTS "${root}/usr/share/doc/sonoglide")
include("${SOURCE}/tools/debian/examples.cmake")
# They take long, or talk to a unit.
set(left_out arithmetic commission connect image pil stability work-precision)
file(REMOVE_RECURSE "${FOLDER}/debian_examples")
file(MAKE_DIRECTORY "${FOLDER}/debian_examples")
foreach(command IN LISTS commands ITEMS identify-impedance identify-friction)
  string(STRIP "${command}" command)
  list(FIND left_out "${command}" at)
  if(NOT at EQUAL -1)
    continue()
  endif()
  set(examples ${examples_sonoglide-${command}})
  while(examples)
    list(POP_FRONT examples line purpose)
    run("${CMAKE_COMMAND}" -E chdir "${FOLDER}/debian_examples"
      "${CMAKE_COMMAND}" -E env "PATH=${root}/usr/bin:$ENV{PATH}" sh -c "${line}")
  endwhile()
endforeach()
if(PYTHON)
  run("${CMAKE_COMMAND}" -E env "PYTHONPATH=${root}/usr/lib/python3/dist-packages" "${PYTHON}" -B -c "
import sonoglide
run = sonoglide.run(sonoglide.Scene('${root}/usr/share/sonoglide/scenes/target_step.toml'))
print(sonoglide.__file__, run.summary['control']['steps'][1]['target'])")
  expect("${output}" HAS "${root}/usr/lib/python3/dist-packages/sonoglide/__init__.py 0.6")
endif()
if(BOARDS)
  # From the sources of the package alone.
  run("${CMAKE_COMMAND}" -E env "XDG_CACHE_HOME=${FOLDER}/debian_cache"
    "${root}/usr/bin/sonoglide" pil "${root}/usr/share/sonoglide/scenes/target_step.toml"
    --board mps2-an386 --out "${FOLDER}/debian_pil")
  expect("${output}" HAS "bit for bit")
  run("${CMAKE_COMMAND}" -E env "XDG_CACHE_HOME=${FOLDER}/debian_cache"
    "${root}/usr/bin/sonoglide" image "${root}/usr/share/sonoglide/scenes/target_step_q31.toml"
    --board pico --out "${FOLDER}/debian_image/unit.uf2")
  expect("${output}" HAS "B flash")
endif()

run(${dpkg} --remove ${names})
file(GLOB_RECURSE left RELATIVE "${root}" "${root}/usr/*")
if(left)
  message(FATAL_ERROR "dpkg leaves behind: ${left}")
endif()
