# Which window renders without a display, and how an executable is linked with it.
#
# SILHOUETTE_OFFSCREEN is one of
#   vtk     VTK has its own OSMesa window: an OSMesa build, or VTK 9.4 and later, which choose at run time
#   module  VTK was built for GLX only: Filters/OffScreen is built, over OSMesa
#   none    neither is possible here; nothing renders off screen
# Needs VTK to have been found. Read by the build and, installed, by vtkSilhouetteConfig.cmake.

# Sets `result` in the caller's scope to ON where VTK's own OSMesa window exists.
function(silhouette_vtk_has_osmesa_window result)
  set(${result} OFF PARENT_SCOPE)
  if(VTK_VERSION VERSION_GREATER_EQUAL 9.4)
    set(${result} ON PARENT_SCOPE)
    return()
  endif()
  # Before 9.4 the only record that an installed VTK keeps is its configured header.
  get_target_property(include_dirs VTK::RenderingOpenGL2 INTERFACE_INCLUDE_DIRECTORIES)
  foreach(dir IN LISTS include_dirs)
    if(EXISTS "${dir}/vtkRenderingOpenGLConfigure.h")
      file(STRINGS "${dir}/vtkRenderingOpenGLConfigure.h" lines REGEX "^#define VTK_OPENGL_HAS_OSMESA")
      if(lines)
        set(${result} ON PARENT_SCOPE)
      endif()
    endif()
  endforeach()
endfunction()

# silhouette_link_offscreen(<executable>)
#
# Links an executable so that it renders with no display; in its source call
# `silhouette::useOffScreenWindow()` of SilhouetteOffScreen.h first in main(). The order of this call and of
# target_link_libraries() does not matter. VTK's other factories (text: VTK::RenderingFreeType) are the
# executable's own business, with vtk_module_autoinit().
function(silhouette_link_offscreen target)
  # Global properties, since a parent project that calls this does not see our variables.
  get_property(kind GLOBAL PROPERTY SILHOUETTE_OFFSCREEN)
  get_property(include_dir GLOBAL PROPERTY SILHOUETTE_OFFSCREEN_INCLUDE_DIR)
  get_property(shim GLOBAL PROPERTY SILHOUETTE_GLX_SHIM_SOURCE)
  get_property(osmesa GLOBAL PROPERTY SILHOUETTE_OSMESA_LIBRARY)
  target_include_directories(${target} PRIVATE "${include_dir}")
  if(kind STREQUAL "vtk")
    target_compile_definitions(${target} PRIVATE SILHOUETTE_OFFSCREEN_VTK)
    target_link_libraries(${target} PRIVATE VTK::RenderingOpenGL2)
  elseif(kind STREQUAL "module")
    target_compile_definitions(${target} PRIVATE SILHOUETTE_OFFSCREEN_MODULE)
    target_sources(${target} PRIVATE "${shim}")
    # VTK's libraries look GLX up in the executable first, and find it only if its symbols are exported.
    set_target_properties(${target} PROPERTIES ENABLE_EXPORTS ON)
    target_link_libraries(${target} PRIVATE Silhouette::OffScreen)
    # As options, OSMesa stands before every library on the link line: OpenGL's entry points resolve to it and
    # not to libGL. The executable itself calls none of them, so the linker must be told to keep it.
    target_link_options(${target} BEFORE PRIVATE
      "LINKER:--push-state,--no-as-needed" "${osmesa}" "LINKER:--pop-state")
  endif()
endfunction()

if(NOT DEFINED SILHOUETTE_OFFSCREEN)
  find_path(SILHOUETTE_OSMESA_INCLUDE_DIR GL/osmesa.h DOC "Where OSMesa's header GL/osmesa.h is")
  find_library(SILHOUETTE_OSMESA_LIBRARY NAMES OSMesa DOC "Mesa's off-screen library")
  mark_as_advanced(SILHOUETTE_OSMESA_INCLUDE_DIR SILHOUETTE_OSMESA_LIBRARY)

  silhouette_vtk_has_osmesa_window(vtk_has_window)
  if(vtk_has_window)
    set(SILHOUETTE_OFFSCREEN vtk)
    message(STATUS "Off-screen rendering: VTK's own OSMesa window")
  elseif(UNIX AND NOT APPLE AND SILHOUETTE_OSMESA_INCLUDE_DIR AND SILHOUETTE_OSMESA_LIBRARY)
    set(SILHOUETTE_OFFSCREEN module)
    message(STATUS "Off-screen rendering: Silhouette::OffScreen over ${SILHOUETTE_OSMESA_LIBRARY}")
  else()
    set(SILHOUETTE_OFFSCREEN none)
    message(STATUS "Off-screen rendering: none (OSMesa not found); tests that render are left out")
  endif()
  set(SILHOUETTE_OFFSCREEN_INCLUDE_DIR "${PROJECT_SOURCE_DIR}/Filters/OffScreen")
  set(SILHOUETTE_GLX_SHIM_SOURCE "${PROJECT_SOURCE_DIR}/Filters/OffScreen/SilhouetteGLXShim.c")
endif()

foreach(name IN ITEMS
    SILHOUETTE_OFFSCREEN
    SILHOUETTE_OFFSCREEN_INCLUDE_DIR
    SILHOUETTE_GLX_SHIM_SOURCE
    SILHOUETTE_OSMESA_LIBRARY)
  set_property(GLOBAL PROPERTY ${name} "${${name}}")
endforeach()
