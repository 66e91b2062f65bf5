"""Makes the Python wheel: CMake builds the module and installs it, with the package around it, into the wheel.

    python3 -m pip wheel . --no-build-isolation --no-deps

CMake's own settings are taken from the environment variable CMAKE_ARGS.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Distribution, Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = Path(__file__).resolve().parent
BUILD = SOURCE / "build" / "wheel"  # kept, so that a second wheel is made in no time


def version() -> str:
    found = re.search(r"project\(facemap VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text())
    return found[1]


class BuildWithCMake(build_ext):
    """Installs CMake's component `python` where setuptools wants the module."""

    def run(self) -> None:
        target = Path(self.build_lib).resolve()
        shutil.rmtree(target / "facemap", ignore_errors=True)  # files of an earlier wheel that are no more
        configure = ["cmake", "-S", SOURCE, "-B", BUILD, "-DCMAKE_BUILD_TYPE=Release", "-DFACEMAP_BUILD_PYTHON=ON",
                     "-DFACEMAP_BUILD_TESTS=OFF", "-DFACEMAP_BUILD_APPS=OFF", "-DBUILD_SHARED_LIBS=OFF",
                     f"-DPython3_EXECUTABLE={sys.executable}", "-DFACEMAP_PYTHON_DIR=."]
        if not (BUILD / "CMakeCache.txt").exists():
            configure += ["-G", "Ninja"]
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count()))
        for command in (configure + shlex.split(os.environ.get("CMAKE_ARGS", "")),
                        ["cmake", "--build", BUILD, "--target", "facemap_python", "--parallel", jobs],
                        ["cmake", "--install", BUILD, "--component", "python", "--prefix", target]):
            subprocess.run(list(map(str, command)), check=True)

    def get_outputs(self) -> list:
        return [str(path) for path in Path(self.build_lib).rglob("*") if path.is_file()]


class WithModule(Distribution):
    """A wheel for one kind of machine."""

    def has_ext_modules(self) -> bool:
        return True


# CMake puts the package together from two folders: there is none that could be used where it lies.
if {"develop", "editable_wheel"} & set(sys.argv):
    sys.exit("facemap cannot be installed editable: install it with `pip install .`, or build it with CMake and set "
             "PYTHONPATH=build/release/python")

EGG_BASE = SOURCE / "build" / "egg"
EGG_BASE.mkdir(parents=True, exist_ok=True)

setup(version=version(), packages=[], ext_modules=[Extension("facemap._facemap", [])], distclass=WithModule,
      cmdclass={"build_ext": BuildWithCMake},
      options={"egg_info": {"egg_base": str(EGG_BASE)}, "build": {"build_base": str(BUILD / "python-build")}})
