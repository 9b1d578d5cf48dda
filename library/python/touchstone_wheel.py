"""The build backend of pyproject.toml (PEP 517): a wheel of the Python package and libtouchstone.

The library is taken from the build folder in TOUCHSTONE_BUILD (default: build/release, as the launcher makes it), and
built there with CMake if it is not up to date.
"""
import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sysconfig
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "library" / "python" / "touchstone"
REQUIRES = ["numpy"]


def _version():
    return re.search(r'^version = "(.*)"', (ROOT / "pyproject.toml").read_text(), re.M)[1]


def _metadata():
    lines = ["Metadata-Version: 2.1", "Name: touchstone", f"Version: {_version()}", "Requires-Python: >=3.9",
             "License: Apache-2.0", *(f"Requires-Dist: {name}" for name in REQUIRES)]
    return "\n".join(lines) + "\n"


def _library():
    build = pathlib.Path(os.environ.get("TOUCHSTONE_BUILD", ROOT / "build" / "release"))
    if not (build / "CMakeCache.txt").exists():
        subprocess.run(["cmake", "-S", ROOT, "-B", build, "-DTOUCHSTONE_TESTS=OFF"], check=True)
    subprocess.run(["cmake", "--build", build, "--target", "ts_library"], check=True)
    (library,) = (build / "lib").glob("libtouchstone.so.[0-9]")
    return library


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    platform = re.sub(r"[-.]", "_", sysconfig.get_platform())
    tag, info = f"py3-none-{platform}", f"touchstone-{_version()}.dist-info"
    library = _library()
    files = {f"touchstone/{p.name}": p.read_bytes() for p in sorted(PACKAGE.glob("*.py"))}
    files[f"touchstone/{library.name}"] = library.read_bytes()
    files["touchstone/py.typed"] = b""
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: touchstone\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()

    def row(name, data):
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        return f"{name},sha256={digest},{len(data)}\n"

    record = "".join(row(name, data) for name, data in files.items()) + f"{info}/RECORD,,\n"
    name = f"touchstone-{_version()}-{tag}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in {**files, f"{info}/RECORD": record.encode()}.items():
            archive.writestr(path, data)
    return name
