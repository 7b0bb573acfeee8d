# The VTK module, its Python wrapping, the off-screen window and the CMake package: what needs VTK.
#
# Afterwards there are
#   Silhouette::FiltersModeling   the filters
#   Silhouette::OffScreen         the window in memory, where SILHOUETTE_OFFSCREEN is `module`
#   SILHOUETTE_PYTHONPATH         the build tree's Python packages (absolute); empty where nothing is wrapped
#   SILHOUETTE_GLX_PRELOAD        what a Python process preloads to render off screen; empty where not needed

set(SILHOUETTE_VTK_COMPONENTS
  CommonCore
  CommonDataModel
  CommonExecutionModel
  CommonMath
  CommonTransforms
  FiltersCore
  FiltersGeneral
  FiltersGeometry
  FiltersHyperTree
  FiltersSources
  IOCore
  IOGeometry
  IOImage
  IOPLY
  IOXML
  ImagingCore
  ParallelCore
  RenderingCore
  RenderingOpenGL2
  tiff
)
set(python_components)
if(SILHOUETTE_WRAP_PYTHON)
  include(SilhouettePython) # before VTK looks for a Python of its own
  set(python_components OPTIONAL_COMPONENTS Python WrappingPythonCore)
endif()
find_package(VTK 9.1 REQUIRED COMPONENTS ${SILHOUETTE_VTK_COMPONENTS} ${python_components})
if(SILHOUETTE_WRAP_PYTHON AND NOT (VTK_WRAP_PYTHON AND TARGET VTK::WrappingPythonCore))
  message(STATUS "Python: this VTK has no Python wrapping, so neither have we")
  set(SILHOUETTE_WRAP_PYTHON OFF)
endif()
include(SilhouetteOffScreen)

# Libraries and programs find each other wherever the install tree is moved to.
set(CMAKE_BUILD_RPATH_USE_ORIGIN ON)
file(RELATIVE_PATH libraries_from_programs
  "/prefix/${CMAKE_INSTALL_BINDIR}" "/prefix/${CMAKE_INSTALL_LIBDIR}")
if(NOT CMAKE_INSTALL_RPATH)
  set(CMAKE_INSTALL_RPATH "$ORIGIN" "$ORIGIN/${libraries_from_programs}")
  set(CMAKE_INSTALL_RPATH_USE_LINK_PATH ON) # a VTK that is not the system's
endif()

# Settled before anything is built: the tests' PYTHONPATH needs it.
set(SILHOUETTE_PYTHONPATH)
set(SILHOUETTE_GLX_PRELOAD)
if(SILHOUETTE_WRAP_PYTHON)
  vtk_module_python_default_destination(SILHOUETTE_PYTHON_DESTINATION)
  set(SILHOUETTE_PYTHONPATH "${CMAKE_BINARY_DIR}/${SILHOUETTE_PYTHON_DESTINATION}")
endif()

set(module_files "${CMAKE_CURRENT_SOURCE_DIR}/Filters/Modeling/vtk.module")
if(SILHOUETTE_OFFSCREEN STREQUAL "module")
  list(APPEND module_files "${CMAKE_CURRENT_SOURCE_DIR}/Filters/OffScreen/vtk.module")
endif()
vtk_module_scan(
  MODULE_FILES ${module_files}
  PROVIDES_MODULES silhouette_modules
  WANT_BY_DEFAULT ON
  ENABLE_TESTS OFF)

set(SILHOUETTE_CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/vtkSilhouette")
set(SILHOUETTE_HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/vtkSilhouette")
vtk_module_build(
  MODULES ${silhouette_modules}
  PACKAGE vtkSilhouette
  INSTALL_EXPORT vtkSilhouette
  VERSION "${PROJECT_VERSION}"
  SOVERSION "${PROJECT_VERSION_MAJOR}"
  HEADERS_DESTINATION "${SILHOUETTE_HEADERS_DESTINATION}"
  CMAKE_DESTINATION "${SILHOUETTE_CMAKE_DESTINATION}"
  TEST_DIRECTORY_NAME NONE) # the tests of every room are in Testing

if(SILHOUETTE_WRAP_PYTHON)
  vtk_module_wrap_python(
    MODULES ${silhouette_modules}
    TARGET Silhouette::Python
    PYTHON_PACKAGE vtksilhouette
    MODULE_DESTINATION "${SILHOUETTE_PYTHON_DESTINATION}"
    LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
    CMAKE_DESTINATION "${SILHOUETTE_CMAKE_DESTINATION}"
    INSTALL_EXPORT vtkSilhouette)
  add_subdirectory(Wrapping/Python)
endif()

# The package: find_package(vtkSilhouette) in the build tree and in the install tree.
include(CMakePackageConfigHelpers)
set(config_dir "${CMAKE_BINARY_DIR}/${SILHOUETTE_CMAKE_DESTINATION}")
configure_package_config_file(
  "${CMAKE_CURRENT_SOURCE_DIR}/CMake/vtkSilhouetteConfig.cmake.in"
  "${config_dir}/vtkSilhouetteConfig.cmake"
  INSTALL_DESTINATION "${SILHOUETTE_CMAKE_DESTINATION}"
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${config_dir}/vtkSilhouetteConfigVersion.cmake"
  VERSION "${PROJECT_VERSION}" COMPATIBILITY SameMinorVersion)
# What silhouette_link_offscreen() needs stands beside the configuration in both trees.
set(offscreen_files
  CMake/SilhouetteOffScreen.cmake
  Filters/OffScreen/SilhouetteGLXShim.c
  Filters/OffScreen/SilhouetteOffScreen.h)
foreach(file IN LISTS offscreen_files)
  get_filename_component(name "${file}" NAME)
  configure_file("${file}" "${config_dir}/${name}" COPYONLY)
endforeach()
install(FILES ${offscreen_files}
  "${config_dir}/vtkSilhouetteConfig.cmake" "${config_dir}/vtkSilhouetteConfigVersion.cmake"
  DESTINATION "${SILHOUETTE_CMAKE_DESTINATION}" COMPONENT development)
