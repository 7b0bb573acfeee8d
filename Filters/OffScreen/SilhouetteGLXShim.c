/* SPDX-License-Identifier: BSD-3-Clause */
/*
 * Answers for GLX with OSMesa, so that a VTK built for GLX renders in memory.
 *
 * VTK's OpenGL loader (GLEW) finds every OpenGL function through glXGetProcAddressARB and gives up where
 * there is no X display. The few GLX functions that it calls are defined here in their place: functions come
 * from OSMesa, and the display is a pointer that is not null and that nobody looks into. They take effect
 * where the dynamic linker meets them before libGL's: linked into an executable that exports its symbols, or
 * preloaded.
 *
 * No header of GLX or OSMesa is included, so that this file compiles anywhere: the types are pointers and
 * ints.
 */
#include <string.h>

#define SILHOUETTE_GLX_API __attribute__((visibility("default")))

typedef void (*silhouetteGLXFunction)(void);

extern silhouetteGLXFunction OSMesaGetProcAddress(const char* name);

SILHOUETTE_GLX_API silhouetteGLXFunction glXGetProcAddressARB(const unsigned char* name);
SILHOUETTE_GLX_API silhouetteGLXFunction glXGetProcAddress(const unsigned char* name);
SILHOUETTE_GLX_API void* glXGetCurrentDisplay(void);
SILHOUETTE_GLX_API int glXQueryVersion(void* display, int* major, int* minor);
SILHOUETTE_GLX_API const char* glXGetClientString(void* display, int name);
SILHOUETTE_GLX_API int silhouetteGLXIsOSMesa(void);

/* What the window looks for, to say clearly that a process was started without this file. */
int silhouetteGLXIsOSMesa(void)
{
  return 1;
}

/* Stands for a display: only its address counts. */
static int notADisplay;

void* glXGetCurrentDisplay(void)
{
  return &notADisplay;
}

/* GLX 1.4, the last version; an int that is not 0 says that it worked. */
int glXQueryVersion(void* display, int* major, int* minor)
{
  (void)display;
  if (major)
  {
    *major = 1;
  }
  if (minor)
  {
    *minor = 4;
  }
  return 1;
}

/* No extensions, no vendor. */
const char* glXGetClientString(void* display, int name)
{
  (void)display;
  (void)name;
  return "";
}

/* OpenGL functions from OSMesa; of GLX's own only the one that a loader asks for by name. */
silhouetteGLXFunction glXGetProcAddressARB(const unsigned char* name)
{
  const char* text = (const char*)name;
  if (strcmp(text, "glXGetCurrentDisplay") == 0)
  {
    return (silhouetteGLXFunction)glXGetCurrentDisplay;
  }
  if (strncmp(text, "glX", 3) == 0)
  {
    return 0;
  }
  return OSMesaGetProcAddress(text);
}

silhouetteGLXFunction glXGetProcAddress(const unsigned char* name)
{
  return glXGetProcAddressARB(name);
}
