# pintle_embed(TARGET FILE SYMBOL) compiles the text of FILE into TARGET as
#   namespace pintle { extern const char* const SYMBOL; }
# The user of the text writes that declaration. The text is renewed when FILE changes. A target without sources of its
# own is left alone.
set(PINTLE_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed_file.cmake)

function(pintle_embed target file symbol)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "INTERFACE_LIBRARY")
    return()
  endif()
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embed_${symbol}.cpp)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DINPUT=${file} -DOUTPUT=${output} -DSYMBOL=${symbol} -P ${PINTLE_EMBED_SCRIPT}
    DEPENDS ${file} ${PINTLE_EMBED_SCRIPT}
    COMMENT "Embedding ${file}"
    VERBATIM)
  # A target of its own, so that the sources of `target` do not wait for the libraries to which it is linked.
  add_custom_target(${target}_${symbol} DEPENDS ${output})
  target_sources(${target} PRIVATE ${output})
endfunction()
