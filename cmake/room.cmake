# A room is a folder of src/ and a target pintle_<room>. It may link only to rooms that stand before it in this list.
set(PINTLE_ROOMS base space model laws probes solve system integrators analyses results io report sweeps)

# Sources of a folder without its tests; a new file needs no edit here.
function(pintle_sources out folder)
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  set(${out} ${sources} PARENT_SCOPE)
endfunction()

# pintle_room(NAME [LINK libraries...]): the target of the current folder, linked to every room on its left. Laws and
# probes do not see each other. A room without a source is a header-only target.
function(pintle_room name)
  cmake_parse_arguments(arg "" "" "LINK" ${ARGN})
  pintle_sources(sources ${CMAKE_CURRENT_SOURCE_DIR})
  list(FIND PINTLE_ROOMS ${name} index)
  list(SUBLIST PINTLE_ROOMS 0 ${index} left)
  if(name STREQUAL "probes")
    list(REMOVE_ITEM left laws)
  endif()
  list(TRANSFORM left PREPEND pintle_)
  if(sources)
    add_library(pintle_${name} STATIC ${sources})
    target_link_libraries(pintle_${name} PUBLIC ${left} ${arg_LINK} PRIVATE pintle_flags)
  else()
    add_library(pintle_${name} INTERFACE)
    target_link_libraries(pintle_${name} INTERFACE ${left} ${arg_LINK})
  endif()
endfunction()

# The rooms that have compiled sources.
function(pintle_compiled_rooms out)
  set(rooms "")
  foreach(room IN LISTS PINTLE_ROOMS)
    get_target_property(type pintle_${room} TYPE)
    if(type STREQUAL "STATIC_LIBRARY")
      list(APPEND rooms pintle_${room})
    endif()
  endforeach()
  set(${out} ${rooms} PARENT_SCOPE)
endfunction()
