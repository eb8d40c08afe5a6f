# run(<command>...): runs it, gives what it printed as `output`, and fails with it.
function(run)
  execute_process(COMMAND ${ARGV}
    RESULT_VARIABLE result OUTPUT_VARIABLE printed ERROR_VARIABLE printed)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGV}\nends with ${result}:\n${printed}")
  endif()
  set(output "${printed}" PARENT_SCOPE)
endfunction()

# expect(<text> HAS|HAS_NO <part>)
function(expect text relation part)
  string(FIND "${text}" "${part}" at)
  if((relation STREQUAL HAS AND at EQUAL -1) OR (relation STREQUAL HAS_NO AND NOT at EQUAL -1))
    message(FATAL_ERROR "Expected: ${relation} ${part}\n${text}")
  endif()
endfunction()
