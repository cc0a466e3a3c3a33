"""Point clouds in PCD 0.7."""

from __future__ import annotations

import ctypes
import ctypes.util
from pathlib import Path

import numpy as np

_MOST_HEADER_BYTES = 4096


def read_pcd(file: Path) -> np.ndarray:
    """A structured array of a cloud's points, its fields as the file names them.

    Reads `ascii`, `binary` and `binary_compressed` (LZF, field by field). Raises ValueError where a file is none or
    ends early.
    """
    data = Path(file).read_bytes()
    header, body = _header_of(data, file)
    dtype = np.dtype([(name, _type_of(kind, size), count) if count > 1 else (name, _type_of(kind, size))
                      for name, kind, size, count in zip(header["FIELDS"], header["TYPE"],
                                                         map(int, header["SIZE"]), map(int, header["COUNT"]))])
    points = int(header["POINTS"][0])
    form = header["DATA"][0]
    if form == "ascii":
        return np.loadtxt(data[body:].decode("ascii").splitlines(), dtype=dtype, ndmin=1)
    if form == "binary_compressed":
        return _by_field(_unpacked(data, body, file), dtype, points, file)
    if len(data) - body < points * dtype.itemsize:
        raise ValueError(f"{file}: {len(data) - body} bytes of points; need {points * dtype.itemsize}")
    return np.frombuffer(data, dtype, points, body)


def _header_of(data: bytes, file: Path) -> tuple[dict[str, list[str]], int]:
    header: dict[str, list[str]] = {}
    at = 0
    while "DATA" not in header:
        end = data.find(b"\n", at, _MOST_HEADER_BYTES)
        if end < 0:
            raise ValueError(f"{file}: no DATA line in its first {_MOST_HEADER_BYTES} bytes; need a PCD file")
        words = data[at:end].decode("ascii", "replace").split()
        if words and not words[0].startswith("#"):
            header[words[0]] = words[1:]
        at = end + 1
    missing = {"FIELDS", "SIZE", "TYPE", "POINTS"} - header.keys()
    if missing:
        raise ValueError(f"{file}: its header lacks {', '.join(sorted(missing))}")
    header.setdefault("COUNT", ["1"] * len(header["FIELDS"]))
    return header, at


def _type_of(kind: str, size: int) -> str:
    return {"F": "<f", "U": "<u", "I": "<i"}[kind] + str(size)


def _unpacked(data: bytes, body: int, file: Path) -> bytes:
    packed_size, size = np.frombuffer(data, "<u4", 2, body)
    packed = data[body + 8:body + 8 + int(packed_size)]
    if len(packed) < packed_size:
        raise ValueError(f"{file}: {len(packed)} bytes of packed points; need {packed_size}")
    unpacked = lzf_unpacked(packed, int(size))
    if len(unpacked) != size:
        raise ValueError(f"{file}: its points unpack to {len(unpacked)} bytes; need {size}")
    return unpacked


def _by_field(data: bytes, dtype: np.dtype, points: int, file: Path) -> np.ndarray:
    if len(data) != points * dtype.itemsize:
        raise ValueError(f"{file}: {len(data)} bytes for {points} points of {dtype.itemsize}")
    cloud = np.empty(points, dtype)
    at = 0
    for name in dtype.names:
        field = dtype[name]
        cloud[name] = np.frombuffer(data, field, points, at)
        at += points * field.itemsize
    return cloud


_library = ctypes.util.find_library("lzf")
_lzf = ctypes.CDLL(_library) if _library else None


def lzf_unpacked(packed: bytes, size: int) -> bytes:
    """What liblzf packed, by that library where it is installed, else by Python, which takes some hundred times as long."""
    if _lzf is None:
        return _lzf_unpacked_slowly(packed)
    out = ctypes.create_string_buffer(max(size, 1))
    count = _lzf.lzf_decompress(packed, ctypes.c_uint(len(packed)), out, ctypes.c_uint(size))
    return out.raw[:count]


def _lzf_unpacked_slowly(packed: bytes) -> bytes:
    """Runs of literals (control byte below 32) and references back, as liblzf's own description has them."""
    out = bytearray()
    at = 0
    while at < len(packed):
        control = packed[at]
        at += 1
        if control < 32:
            out += packed[at:at + control + 1]
            at += control + 1
            continue
        length = control >> 5
        if length == 7:
            length += packed[at]
            at += 1
        start = len(out) - ((control & 31) << 8) - packed[at] - 1
        at += 1
        for _ in range(length + 2):
            out.append(out[start])
            start += 1
    return bytes(out)
