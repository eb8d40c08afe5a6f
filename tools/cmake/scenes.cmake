# Run by `cmake --install`: the example scenes in SCENES to FOLDER, with the JSON Schema that editors judge
# them by. The first line of each names the schema by its place on this machine, so that a copy in any
# folder names it too. STAGED is a folder of the build.
file(GLOB scenes "${SCENES}/*.toml")
foreach(scene IN LISTS scenes)
  cmake_path(GET scene FILENAME name)
  file(READ "${scene}" text)
  string(REPLACE "# A scene of sonoglide: keys.md explains each key.\n"
    "#:schema ${FOLDER}/scene.schema.json\n" text "${text}")
  file(WRITE "${STAGED}/${name}" "${text}")
  file(INSTALL "${STAGED}/${name}" DESTINATION "${FOLDER}" MESSAGE_NEVER)
endforeach()
file(INSTALL "${SCENES}/scene.schema.json" DESTINATION "${FOLDER}" MESSAGE_NEVER)
