# How tests that use VTK are built and run.

# silhouette_add_vtk_test(<stem> [THREADS <n>] [LIBRARIES <target>...])
#
# Builds Test<stem>.cxx of the calling folder (GoogleTest, without a main of its own) with the off-screen
# window, and registers its cases as Cxx.<stem>.*. THREADS sets the threads of VTK's parallel loops (default:
# all). No test sees a DISPLAY. The source finds RegressionImage.h.
function(silhouette_add_vtk_test stem)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "THREADS" "LIBRARIES")
  set(name "Test${stem}")
  set(modules ${SILHOUETTE_VTK_COMPONENTS})
  list(TRANSFORM modules PREPEND "VTK::")
  list(APPEND modules Silhouette::FiltersModeling)

  add_executable(${name} ${name}.cxx "${PROJECT_SOURCE_DIR}/Testing/Cxx/TestMain.cxx")
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/Testing/Cxx")
  target_link_libraries(${name} PRIVATE GTest::gtest ${modules} ${arg_LIBRARIES})
  target_compile_definitions(${name} PRIVATE
    "SILHOUETTE_BASELINE_DIR=\"${PROJECT_SOURCE_DIR}/Testing/Data/Baseline\""
    "SILHOUETTE_TEMPORARY_DIR=\"${SILHOUETTE_TEMPORARY_DIR}\"")
  silhouette_link_offscreen(${name})
  vtk_module_autoinit(TARGETS ${name} MODULES ${modules})
  silhouette_compile_options(${name})

  set(environment)
  if(arg_THREADS)
    set(environment ENVIRONMENT "SILHOUETTE_TEST_THREADS=${arg_THREADS}")
  endif()
  gtest_discover_tests(${name} TEST_PREFIX "Cxx." PROPERTIES
    LABELS Cxx ENVIRONMENT_MODIFICATION "DISPLAY=unset:" ${environment})
endfunction()

# silhouette_add_python_test(<name> [OFFSCREEN])
#
# Runs <name>.py of the calling folder (unittest) against the build tree's package, as Python.<name>; with
# OFFSCREEN in a process that can render in memory. Exit code 77 is a skipped test.
function(silhouette_add_python_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "OFFSCREEN" "" "")
  set(environment "PYTHONPATH=${SILHOUETTE_PYTHONPATH}" "PYTHONDONTWRITEBYTECODE=1")
  if(arg_OFFSCREEN AND SILHOUETTE_OFFSCREEN STREQUAL "none")
    return()
  endif()
  if(arg_OFFSCREEN AND SILHOUETTE_GLX_PRELOAD)
    list(APPEND environment "LD_PRELOAD=${SILHOUETTE_GLX_PRELOAD}")
  elseif(arg_OFFSCREEN)
    list(APPEND environment "VTK_DEFAULT_OPENGL_WINDOW=vtkOSOpenGLRenderWindow")
  endif()
  add_test(NAME "Python.${name}" COMMAND "${Python3_EXECUTABLE}" "${CMAKE_CURRENT_SOURCE_DIR}/${name}.py")
  set_tests_properties("Python.${name}" PROPERTIES
    LABELS Python
    SKIP_RETURN_CODE 77
    ENVIRONMENT "${environment}"
    ENVIRONMENT_MODIFICATION "DISPLAY=unset:")
endfunction()
