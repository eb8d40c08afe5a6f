# What the tables of the budget are measured on: an image of each closed-loop example scene in
# float32 and in q31, for every core, and images that differ by one part of the controller. Adds to
# the controllers that the boards are configured with.

# sonoglide_scene_images(<list> <scene> <its text, in float32>): adds <scene> to <list>_float32, and
# <scene>_q31 to <list>_q31.
function(sonoglide_scene_images list scene text)
  set(image_float32 ${scene})
  set(image_q31 ${scene}_q31)
  foreach(arithmetic float32 q31)
    set(image ${image_${arithmetic}})
    set(${list}_${arithmetic} ${${list}_${arithmetic}} ${image} PARENT_SCOPE)
    if(NOT image IN_LIST checked_images)
      set(file "${CMAKE_CURRENT_BINARY_DIR}/scenes/${image}.toml")
      string(REPLACE "\"float32\"" "\"${arithmetic}\"" configured "${text}")
      file(CONFIGURE OUTPUT "${file}" CONTENT "${configured}" @ONLY)
      sonoglide_configure(${image} "${file}")
    endif()
  endforeach()
  set(folders ${folders} PARENT_SCOPE)
  set(headers ${headers} PARENT_SCOPE)
endfunction()

set(budget_scenes "")
file(GLOB files CONFIGURE_DEPENDS "${scenes}/*.toml")
foreach(file IN LISTS files)
  file(READ "${file}" text)
  if(text MATCHES "arithmetic = \"float32\"")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
    get_filename_component(scene "${file}" NAME_WE)
    string(APPEND budget_scenes "${scene} ")
    sonoglide_scene_images(budget_images ${scene} "${text}")
  endif()
endforeach()

# The scenes whose unit is measured as well: what it takes in lockstep, and the bytes of its product.
set(budget_units target_step damped_by_force)
set(unit_images "")
foreach(scene IN LISTS budget_units)
  foreach(image ${scene} ${scene}_q31)
    list(APPEND unit_images ${image}_counted ${image}_timed)
  endforeach()
endforeach()
list(JOIN budget_units " " budget_units)

# sonoglide_feature_image(<scene> [<text> <replacement>]...): every part, but for what is replaced.
function(sonoglide_feature_image scene)
  set(text "${every_part}")
  while(ARGN)
    list(POP_FRONT ARGN from to)
    string(REPLACE "${from}" "${to}" text "${text}")
  endwhile()
  sonoglide_scene_images(feature_images ${scene} "${text}")
  set(feature_images_float32 ${feature_images_float32} PARENT_SCOPE)
  set(feature_images_q31 ${feature_images_q31} PARENT_SCOPE)
  set(folders ${folders} PARENT_SCOPE)
  set(headers ${headers} PARENT_SCOPE)
endfunction()

set(every_part_file "${CMAKE_CURRENT_SOURCE_DIR}/every_part.toml")
file(READ "${every_part_file}" every_part)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${every_part_file}")
set(no_shaping "[controller]" "[controller]\nshaping = \"none\"")
# A natural mode on a multiple of the carrier can neither be notched out nor fed back to.
set(on_a_multiple "frequency_Hz = 60e3" "frequency_Hz = 6.489e3")
sonoglide_feature_image(every_part)
sonoglide_feature_image(no_shaping ${no_shaping})
sonoglide_feature_image(five_taps "[controller]" "[controller]\nshaping = \"robust\"")
sonoglide_feature_image(no_feedback ${on_a_multiple})
sonoglide_feature_image(no_calibration "calibration_s = 0.5e-3" "calibration_s = 0.0")
sonoglide_feature_image(relearning "[controller]" "[controller]\nrelearn_every_s = 10e-3")
sonoglide_feature_image(tracking "calibration_s = 0.5e-3" "friction = \"tracked\"")
sonoglide_feature_image(no_slew_limit "max_force_slew_N_per_s = 10e6" "")
sonoglide_feature_image(felt_mode "max_force_slew_N_per_s = 10e6" ""
  "[controller]" "[controller]\nvibration = \"damped\"")
# A contact that slides through its presliding distance in 7.9 carrier periods, and one that does in 4.0, which is
# too prompt for a lead.
set(stiffness_slow_contact 5.6e3)
set(stiffness_prompt_contact 11e3)
foreach(image slow_contact prompt_contact)
  sonoglide_feature_image(${image} "max_force_slew_N_per_s = 10e6" ""
    "[controller]" "[controller]\nvibration = \"damped\""
    "contact_stiffness_N_per_m = 0.056e6" "contact_stiffness_N_per_m = ${stiffness_${image}}"
    "calibration_s = 0.5e-3" "calibration_s = 1.5e-3")
endforeach()
sonoglide_feature_image(coulomb "\"dahl\"" "\"coulomb\"" "contact_stiffness_N_per_m = 0.056e6" "")
# A natural mode at 2.01 carrier frequencies under a drive that ramps: the gain of the feedback adapts, unless the mode
# loses a fifth of its free vibration in a period. The two dampings lie just beside that edge, so that the images
# differ in this part alone, and there is no calibration: see host_sim/boards/emulated/README.md.
set(beside_multiple_part "stiffness_N_per_m = 133e6" "stiffness_N_per_m = 11.484e9\ndamping_N_s_per_m = 530.0"
  "max_force_amplitude_N = 1920.0" "max_force_amplitude_N = 6000.0"
  "max_force_slew_N_per_s = 10e6" "interpolation = \"linear\"" "calibration_s = 0.5e-3" "calibration_s = 0.0")
sonoglide_feature_image(adaptive_gain ${beside_multiple_part})
sonoglide_feature_image(constant_gain ${beside_multiple_part} "= 530.0" "= 540.0")
