# SPDX-License-Identifier: BSD-3-Clause
"""Rendering in memory, with no display, no X server and no graphics card.

Run any script that uses VTK's windows:

    python3 -m vtksilhouette.offscreen SCRIPT [ARGUMENT ...]

or prepare a process yourself: start it with the variables of environment(), and call enable() before the
first vtkRenderWindow is made:

    from vtksilhouette import offscreen
    subprocess.run([sys.executable, "script.py"], env={**os.environ, **offscreen.environment()})

The preloaded library concerns VTK builds that know only GLX: it must be there before Python loads VTK, which
is why a running process cannot switch it on.
"""

import ctypes
import importlib
import os
import runpy
import sys

__all__ = ["enable", "environment", "is_prepared", "main"]

_LIBRARY = os.path.join(os.path.dirname(os.path.abspath(__file__)), "libsilhouetteglx.so")


def _needs_preload():
    """Whether this build has a window of its own over OSMesa, rather than VTK's."""
    return os.path.exists(_LIBRARY)


def environment():
    """The environment variables (a dict) that a Python process needs from its start to render in memory."""
    if not _needs_preload():
        return {"VTK_DEFAULT_OPENGL_WINDOW": "vtkOSOpenGLRenderWindow"}
    others = os.environ.get("LD_PRELOAD", "")
    return {"LD_PRELOAD": (_LIBRARY + " " + others).strip()}


def is_prepared():
    """Whether this process was started with the variables of environment()."""
    if not _needs_preload():
        return "VTK_DEFAULT_OPENGL_WINDOW" in os.environ
    return hasattr(ctypes.CDLL(None), "silhouetteGLXIsOSMesa")


def enable():
    """Makes every later vtkRenderWindow() a window in memory.

    Raises RuntimeError where the process was not started for it (see environment()).
    """
    if not _needs_preload():
        os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkOSOpenGLRenderWindow")
        return
    if not is_prepared():
        raise RuntimeError(
            "this process cannot render in memory: start it as 'python3 -m vtksilhouette.offscreen SCRIPT', "
            "or with LD_PRELOAD=" + _LIBRARY)
    module = importlib.import_module(__package__ + ".vtkSilhouetteOffScreen")
    module.vtkSilhouetteOffScreenFactory.EnableOffScreen()


def main(arguments):
    """Runs the script arguments[0] with the rest as its arguments, in a process that renders in memory."""
    if not arguments or arguments[0] in ("-h", "--help"):
        print(__doc__.strip())
        return 0 if arguments else 2
    if not is_prepared():
        os.environ.update(environment())
        # Python's own options are kept; -m stands again, since the module must be found the same way.
        os.execv(sys.executable, [sys.executable, "-m", "vtksilhouette.offscreen", *arguments])
    if _needs_preload():
        # Children of the script are processes of their own.
        os.environ["LD_PRELOAD"] = os.environ.get("LD_PRELOAD", "").replace(_LIBRARY, "").strip()
    enable()
    sys.argv = list(arguments)
    sys.path[0] = os.path.dirname(os.path.abspath(arguments[0]))
    runpy.run_path(arguments[0], run_name="__main__")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
