# Warnings for our own targets only, the one compiler flag that results depend on, and a strict linker.
option(SILHOUETTE_WARNINGS_AS_ERRORS "Treat warnings in our own targets as errors" OFF)

function(silhouette_compile_options target)
  target_compile_options(${target} PRIVATE
    # A contracted multiply-add would round a corner's projection differently from place to place.
    -ffp-contract=off
    $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wshadow -Wnon-virtual-dtor>)
  if(SILHOUETTE_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  # A function that no source defines fails here, and not in the process that loads the library. Not with
  # sanitizers, whose functions the executable brings.
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "SHARED_LIBRARY" AND CMAKE_SYSTEM_NAME STREQUAL "Linux"
      AND NOT "${CMAKE_C_FLAGS} ${CMAKE_CXX_FLAGS}" MATCHES "-fsanitize")
    target_link_options(${target} PRIVATE "LINKER:--no-undefined")
  endif()
endfunction()
