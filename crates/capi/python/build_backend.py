"""Builds the wheel: the package, and the shared library inside it.

    cargo build --release -p glidepath-capi
    pip wheel --no-deps crates/capi/python

The library is that of target/release, or the one that GLIDEPATH_LIBRARY names. A wheel is a zip with
three files that say what is in it (PyPA's binary distribution format); making it here needs neither
setuptools nor the network.
"""

import base64
import hashlib
import os
import shutil
import subprocess
import sysconfig
import tempfile
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
# Its name carries the version of the ABI, as the package's structures do.
ABI = next(
    line.split()[-1]
    for line in (HERE / "glidepath/_layout.py").read_text().splitlines()
    if line.startswith("ABI = ")
)
LIBRARY = f"libglidepath.so.{ABI}"
NAME, SUMMARY = "glidepath", "Glidepath's setpoints, status, commands and servo, with its library"


def _version():
    for line in (HERE / "pyproject.toml").read_text().splitlines():
        if line.startswith("version = "):
            return line.split('"')[1]
    raise SystemExit("pyproject.toml has no version")


def _library():
    """The library as it goes into the wheel: without debugging information, if it can be taken out."""
    named = os.environ.get("GLIDEPATH_LIBRARY")
    path = Path(named) if named else ROOT / "target/release/libglidepath.so"
    if not path.is_file():
        raise SystemExit(
            f"{path} is not there: `cargo build --release -p glidepath-capi` makes it, or name another "
            "with GLIDEPATH_LIBRARY"
        )
    if shutil.which("strip") is None:
        return path.read_bytes()
    with tempfile.TemporaryDirectory() as folder:
        stripped = Path(folder) / LIBRARY
        subprocess.run(["strip", "--strip-debug", "-o", stripped, path], check=True)
        return stripped.read_bytes()


def _files(info, tag):
    files = {f"{NAME}/{path.name}": path.read_bytes() for path in sorted((HERE / NAME).glob("*.py"))}
    files[f"{NAME}/{LIBRARY}"] = _library()
    for name in ("LICENSE-MIT", "LICENSE-APACHE"):
        files[f"{info}/{name}"] = (ROOT / name).read_bytes()
    metadata = (
        f"Metadata-Version: 2.1\nName: {NAME}\nVersion: {_version()}\nSummary: {SUMMARY}\n"
        "License: MIT OR Apache-2.0\nRequires-Python: >=3.9\n"
    )
    files[f"{info}/METADATA"] = metadata.encode()
    wheel = f"Wheel-Version: 1.0\nGenerator: glidepath\nRoot-Is-Purelib: false\nTag: {tag}\n"
    files[f"{info}/WHEEL"] = wheel.encode()
    return files


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """The hook of PEP 517."""
    tag = "py3-none-" + sysconfig.get_platform().replace("-", "_").replace(".", "_")
    info = f"{NAME}-{_version()}.dist-info"
    name = f"{NAME}-{_version()}-{tag}.whl"
    record = ""
    with zipfile.ZipFile(Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, content in _files(info, tag).items():
            wheel.writestr(path, content)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=")
            record += f"{path},sha256={digest.decode()},{len(content)}\n"
        wheel.writestr(f"{info}/RECORD", f"{record}{info}/RECORD,,\n")
    return name
