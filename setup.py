"""The Python package as a wheel: CMake builds and installs it (pyproject.toml says how to run this)."""

import os
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).parent.resolve()
VERSION = re.search(r"project\(morsel VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


class CMakeBuild(build_ext):
    """Everything in the package comes from CMake's component `python`."""

    def run(self):
        build = pathlib.Path(self.build_temp).resolve() / "cmake"
        prefix = ROOT if self.inplace else pathlib.Path(self.build_lib).resolve()
        options = {
            "CMAKE_BUILD_TYPE": "Release", "MORSEL_BUILD_PYTHON": "ON", "MORSEL_BUILD_TOOLS": "OFF",
            "MORSEL_BUILD_TESTS": "OFF", "MORSEL_WITH_PICTURES": "OFF", "MORSEL_PYTHON": sys.executable,
            "MORSEL_PYTHON_DESTINATION": "."}
        subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja",
                        *(f"-D{name}={value}" for name, value in options.items()),
                        *os.environ.get("CMAKE_ARGS", "").split()], check=True)
        jobs = ["-j", str(self.parallel)] if self.parallel else []
        subprocess.run(["cmake", "--build", build, "--target", "morsel_python", *jobs], check=True)
        subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix", prefix], check=True)


setup(version=VERSION, packages=[], ext_modules=[Extension("morsel._library", sources=[])],
      cmdclass={"build_ext": CMakeBuild})
