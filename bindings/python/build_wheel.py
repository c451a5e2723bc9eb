"""Makes wheels for pip (PEP 517): CMake builds and installs the package, this puts it into a wheel.

The version is that of the C header. The setting `build-dir` (--config-settings build-dir=FOLDER)
names a folder that is kept; one that CMake has configured is built as it is.
"""
import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]


def _version():
    text = (ROOT / "include/tetstream/version.h").read_text(encoding="ascii")
    return ".".join(re.search(rf"TETSTREAM_VERSION_{part} (\d+)", text)[1]
                    for part in ("MAJOR", "MINOR", "PATCH"))


def _metadata():
    head = {"Metadata-Version": "2.1", "Name": "tetstream", "Version": _version(),
            "Summary": "Simplifies tetrahedral meshes with fields as a stream",
            "License": "BSD-3-Clause", "Requires-Python": ">=3.9", "Requires-Dist": "numpy",
            "Description-Content-Type": "text/markdown"}
    lines = "".join(f"{name}: {value}\n" for name, value in head.items())
    return lines + "\n" + (ROOT / "README.md").read_text(encoding="utf-8")


def _run(*words):
    subprocess.run([str(word) for word in words], check=True)


def _install(build, staging):
    """Builds and installs the package alone; returns its folder."""
    if not (build / "CMakeCache.txt").exists():
        _run("cmake", "-S", ROOT, "-B", build, "-DCMAKE_BUILD_TYPE=Release",
             "-DTETSTREAM_PYTHON=ON", "-DTETSTREAM_BUILD_CLI=OFF", "-DTETSTREAM_BUILD_TESTS=OFF",
             f"-DPython3_EXECUTABLE={sys.executable}", "-DTETSTREAM_PYTHON_DIR=packages")
    _run("cmake", "--build", build, "--parallel", os.cpu_count() or 1, "--target",
         "tetstream_python", "tetstream_python_modules")
    _run("cmake", "--install", build, "--component", "python", "--prefix", staging)
    return next(staging.rglob("tetstream/__init__.py")).parent


def _write(path, files):
    """A wheel of pairs of name and bytes; RECORD comes last."""
    info = f"tetstream-{_version()}.dist-info"
    record = []
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        for name, data in files:
            name = name.replace("INFO", info)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record.append(f"{name},sha256={digest},{len(data)}\n")
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))  # the same bytes each time
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o755 if name.endswith(".so") else 0o644) << 16
            wheel.writestr(entry, data)
        wheel.writestr(f"{info}/RECORD", "".join(record) + f"{info}/RECORD,,\n")


def _tag():
    version = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{version}-{version}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def _info():
    """What a wheel says of itself: pairs of name and bytes."""
    about = f"Wheel-Version: 1.0\nGenerator: tetstream\nRoot-Is-Purelib: false\nTag: {_tag()}\n"
    return [("METADATA", _metadata().encode()), ("WHEEL", about.encode()),
            ("LICENSE", (ROOT / "LICENSE").read_bytes())]


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """So that nobody has to build the package to know its name."""
    folder = f"tetstream-{_version()}.dist-info"
    os.mkdir(os.path.join(metadata_directory, folder))
    for name, data in _info():
        pathlib.Path(metadata_directory, folder, name).write_bytes(data)
    return folder


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    name = f"tetstream-{_version()}-{_tag()}.whl"
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        build = (config_settings or {}).get("build-dir")
        package = _install(pathlib.Path(build).resolve() if build else scratch / "build",
                           scratch / "staging")
        files = [(f"tetstream/{path.name}", path.read_bytes()) for path in
                 sorted(package.iterdir()) if path.is_file()]
        files += [("INFO/" + entry, data) for entry, data in _info()]
        _write(os.path.join(wheel_directory, name), files)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """All that is in the repository."""
    base = f"tetstream-{_version()}"
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], check=True,
                            stdout=subprocess.PIPE).stdout.decode().split("\0")
    with tempfile.TemporaryDirectory() as scratch:
        about = os.path.join(scratch, "PKG-INFO")
        with open(about, "w", encoding="utf-8") as file:
            file.write(_metadata())
        with tarfile.open(os.path.join(sdist_directory, base + ".tar.gz"), "w:gz",
                          format=tarfile.PAX_FORMAT) as archive:
            archive.add(about, f"{base}/PKG-INFO")
            for path in filter(None, listed):
                archive.add(ROOT / path, f"{base}/{path}")
    return base + ".tar.gz"
