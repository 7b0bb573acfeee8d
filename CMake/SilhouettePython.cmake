# Chooses the Python that VTK's modules belong to. The first python3 on PATH is often another one (a virtual
# environment, pyenv) that cannot import VTK; the system's is then tried. A Python3_EXECUTABLE
# that is given stands.
#
# Sets Python3_EXECUTABLE (cache) and SILHOUETTE_PYTHON_HAS_VTK.

# Sets `result` in the caller's scope to whether `interpreter` imports VTK's modules.
function(silhouette_python_has_vtk interpreter result)
  execute_process(COMMAND "${interpreter}" -c "import vtkmodules.vtkCommonCore"
    RESULT_VARIABLE code OUTPUT_QUIET ERROR_QUIET)
  if(code EQUAL 0)
    set(${result} ON PARENT_SCOPE)
  else()
    set(${result} OFF PARENT_SCOPE)
  endif()
endfunction()

if(Python3_EXECUTABLE)
  silhouette_python_has_vtk("${Python3_EXECUTABLE}" SILHOUETTE_PYTHON_HAS_VTK)
else()
  set(SILHOUETTE_PYTHON_HAS_VTK OFF)
  find_program(SILHOUETTE_FIRST_PYTHON NAMES python3 DOC "The first python3 on PATH")
  mark_as_advanced(SILHOUETTE_FIRST_PYTHON)
  foreach(candidate IN ITEMS "${SILHOUETTE_FIRST_PYTHON}" /usr/bin/python3)
    if(candidate AND EXISTS "${candidate}" AND NOT SILHOUETTE_PYTHON_HAS_VTK)
      silhouette_python_has_vtk("${candidate}" SILHOUETTE_PYTHON_HAS_VTK)
      if(SILHOUETTE_PYTHON_HAS_VTK)
        set(Python3_EXECUTABLE "${candidate}" CACHE FILEPATH "The Python that imports VTK's modules")
        message(STATUS "Python: ${candidate} (imports vtkmodules)")
      else()
        message(STATUS "Python: ${candidate} has no vtkmodules, not used")
      endif()
    endif()
  endforeach()
endif()
if(NOT SILHOUETTE_PYTHON_HAS_VTK)
  message(STATUS "Python: no interpreter imports vtkmodules; the Python tests are left out")
endif()
