# sonoglide_require_class(<call> <argument> <class> <header>): ends the configuration with the argument of that call
# where the header does not have the name of the class; a compiler would tell of it by pages.
function(sonoglide_require_class call argument class header)
  if(NOT class)
    message(FATAL_ERROR "${call}: ${argument} is missing")
  endif()
  file(READ "${header}" text)
  string(REGEX REPLACE "<.*" "" name "${class}")
  string(REGEX REPLACE ".*::" "" name "${name}")
  if(NOT text MATCHES "(^|[^A-Za-z0-9_])${name}($|[^A-Za-z0-9_])")
    message(FATAL_ERROR "${call}: ${argument} ${class}: there is no ${name} in ${header}; allowed: a class that it "
      "defines, or a name that it gives one by `using`")
  endif()
endfunction()
