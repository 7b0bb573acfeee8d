# Examples/ParaView, run as people run them, and judged. With what CMakeLists.txt has found: pvpython, its environment.
if(NOT SILHOUETTE_PVPYTHON)
  return()
endif()
find_program(SILHOUETTE_XVFB_RUN NAMES xvfb-run)
mark_as_advanced(SILHOUETTE_XVFB_RUN)
set(display "")
if(SILHOUETTE_XVFB_RUN)
  # The scripts draw one after the other: a server that resets itself when one has gone is not there for the next.
  set(display "${SILHOUETTE_XVFB_RUN}" -a -s "-screen 0 1280x960x24 -noreset")
endif()
add_test(NAME ParaView.TestParaViewExamples
  COMMAND ${display} "${SILHOUETTE_PVPYTHON}" "${CMAKE_CURRENT_LIST_DIR}/TestParaViewExamples.py")
set_tests_properties(ParaView.TestParaViewExamples PROPERTIES
  LABELS "ParaView;Examples"
  SKIP_RETURN_CODE 77
  TIMEOUT 900
  ENVIRONMENT "${environment}"
  ENVIRONMENT_MODIFICATION "LD_PRELOAD=unset:")
