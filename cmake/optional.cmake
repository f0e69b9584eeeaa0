# pintle_absent(OPTION WHAT WITHOUT): a library that is optional is not there. Where OPTION is AUTO this says what Pintle is built
# without; where it is ON it is an error.
function(pintle_absent option what without)
  if(${option} STREQUAL "AUTO")
    message(STATUS "${what} is absent: ${without}")
  else()
    message(FATAL_ERROR "${option} is ON, and ${what} is absent")
  endif()
endfunction()
