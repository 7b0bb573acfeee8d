# Warnings for our own targets only, and the one compiler flag that results depend on.
option(SILHOUETTE_WARNINGS_AS_ERRORS "Treat warnings in our own targets as errors" OFF)

function(silhouette_compile_options target)
  target_compile_options(${target} PRIVATE
    # A contracted multiply-add would round a corner's projection differently from place to place.
    -ffp-contract=off
    $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wshadow -Wnon-virtual-dtor>)
  if(SILHOUETTE_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()
