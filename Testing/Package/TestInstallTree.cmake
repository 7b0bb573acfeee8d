# Installs the build tree, moves the install tree elsewhere, and uses it from there: files name no folder of
# this machine, the program runs, a project of its own configures, builds and runs against it, Python imports
# the package, and the examples make what they promise. Skipped, with the line "SKIPPED: why", where the build
# tree is not complete.

# run(<what> [OUTPUT <variable>] COMMAND <command>...): fails, with all that was printed, unless the command
# succeeds; OUTPUT gives what it printed.
function(run what)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "OUTPUT" "COMMAND")
  string(TIMESTAMP begin "%s")
  execute_process(COMMAND ${arg_COMMAND}
    RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(TIMESTAMP end "%s")
  math(EXPR seconds "${end} - ${begin}")
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${what} failed (${code}):\n${output}")
  endif()
  message(STATUS "${what}: ${seconds} s")
  if(arg_OUTPUT)
    set(${arg_OUTPUT} "${output}" PARENT_SCOPE)
  endif()
endfunction()

file(REMOVE_RECURSE "${WORK_DIR}")
file(MAKE_DIRECTORY "${WORK_DIR}/moved")
set(prefix "${WORK_DIR}/moved/prefix")

set(config)
if(CONFIG)
  set(config --config "${CONFIG}")
endif()
execute_process(
  COMMAND "${CMAKE_COMMAND}" --install "${BUILD_DIR}" ${config} --prefix "${WORK_DIR}/installed"
  RESULT_VARIABLE code OUTPUT_QUIET ERROR_VARIABLE output)
if(NOT code EQUAL 0)
  if(output MATCHES "file INSTALL cannot find")
    message(STATUS "SKIPPED: not everything is built, so nothing can be installed:\n${output}")
    return()
  endif()
  message(FATAL_ERROR "the installation failed:\n${output}")
endif()
file(RENAME "${WORK_DIR}/installed" "${prefix}")

# The package's files must not lead back to the build tree or to where they were installed at first.
file(GLOB_RECURSE texts "${prefix}/*.cmake" "${prefix}/*.h" "${prefix}/*.py" "${prefix}/*.json")
foreach(text IN LISTS texts)
  file(READ "${text}" content)
  foreach(folder IN ITEMS "${BUILD_DIR}" "${CMAKE_CURRENT_LIST_DIR}")
    string(FIND "${content}" "${folder}" place)
    if(NOT place EQUAL -1)
      message(FATAL_ERROR "${text} names the folder ${folder}")
    endif()
  endforeach()
endforeach()

if(PROGRAM)
  run("the program" COMMAND "${prefix}/${BIN_DIR}/vtksilhouette" --version)
endif()

run("configuring the consumer" COMMAND
  "${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/Consumer" -B "${WORK_DIR}/consumer" -G "${GENERATOR}"
    -DCMAKE_BUILD_TYPE=Release
    "-DCMAKE_C_COMPILER=${C_COMPILER}"
    "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}"
    "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}"
    "-DVTK_DIR=${VTK_DIR}"
    "-DvtkSilhouette_DIR=${prefix}/${PACKAGE_DIR}")
run("building the consumer" COMMAND "${CMAKE_COMMAND}" --build "${WORK_DIR}/consumer" --config Release)
run("running the consumer" OUTPUT counts COMMAND "${WORK_DIR}/consumer/bin/counts")
message(STATUS "${counts}")
if(NOT counts MATCHES "local hulls: [1-9][0-9]* points, [1-9][0-9]* triangles")
  message(FATAL_ERROR "the consumer printed:\n${counts}")
endif()
if(NOT OFFSCREEN STREQUAL "none")
  run("rendering in the consumer" COMMAND "${WORK_DIR}/consumer/bin/picture")
endif()

if(PYTHON)
  # The package's own tests, against the moved tree.
  foreach(test IN ITEMS TestImport TestOffScreenLauncher)
    if(NOT (test STREQUAL "TestOffScreenLauncher" AND OFFSCREEN STREQUAL "none"))
      run("Python's ${test}" COMMAND
        "${CMAKE_COMMAND}" -E env --unset=LD_PRELOAD "PYTHONPATH=${prefix}/${PYTHON_PATH}"
          PYTHONDONTWRITEBYTECODE=1 "${PYTHON}" "${CMAKE_CURRENT_LIST_DIR}/../Python/${test}.py")
    endif()
  endforeach()
  run("where Python finds the package" OUTPUT place COMMAND
    "${CMAKE_COMMAND}" -E env "PYTHONPATH=${prefix}/${PYTHON_PATH}" PYTHONDONTWRITEBYTECODE=1
      "${PYTHON}" -c "import vtksilhouette; print(vtksilhouette.vtkLocalHullSurfacer.__module__, vtksilhouette.__file__)")
  string(FIND "${place}" "${prefix}" found)
  if(found EQUAL -1)
    message(FATAL_ERROR "Python imported another package: ${place}")
  endif()
endif()

if(PYTHON AND PROGRAM AND NOT OFFSCREEN STREQUAL "none")
  # Examples/Python and Examples/Cxx, built and run by the document's commands. Real photographs, and what does
  # not concern the install tree, are left to the build tree's run of this test.
  run("the examples" COMMAND
    "${CMAKE_COMMAND}" -E env --unset=LD_PRELOAD
      "SILHOUETTE_PREFIX=${prefix}" "SILHOUETTE_PROGRAM=${BIN_DIR}/vtksilhouette" SILHOUETTE_REAL_DATA=none
      "PYTHONPATH=${prefix}/${PYTHON_PATH}" PYTHONDONTWRITEBYTECODE=1
      "CMAKE_GENERATOR=${GENERATOR}" "CC=${C_COMPILER}" "CXX=${CXX_COMPILER}" "CXXFLAGS=${CXX_FLAGS}"
      "VTK_DIR=${VTK_DIR}"
      "${PYTHON}" "${CMAKE_CURRENT_LIST_DIR}/../Examples/TestExamples.py"
      Package Readme.test_the_prefix PhotographsToMesh JudgedMesh VoteShareSweep NumpyMasks)
endif()
file(REMOVE_RECURSE "${WORK_DIR}")
