"""Reads recordings as docs/FORMATS.md describes them. Checksums are not checked."""

import json
import struct
import zlib

import numpy as np


class Recording:
    """Columns of float32 by name, one number per frame, and the header's JSON."""

    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        magic, version, length, _ = struct.unpack_from("<8sIQQ", data)
        if (magic, version) != (b"AMBLEREC", 1):
            raise ValueError(f"{path}: not a recording of version 1")
        at = struct.calcsize("<8sIQQ")
        self.header = json.loads(data[at : at + length])
        at += length
        columns = self.header["columns"]
        chunks = []
        while True:
            frames, size, _ = struct.unpack_from("<IIQ", data, at)
            at += struct.calcsize("<IIQ")
            if frames == 0:
                break
            planes = np.frombuffer(zlib.decompress(data[at : at + size]), np.uint8)
            # Highest byte first; in a plane column by column, frame by frame.
            big_endian = planes.reshape(4, len(columns), frames).transpose(1, 2, 0)
            chunks.append(np.ascontiguousarray(big_endian).view(">f4")[:, :, 0])
            at += size
        values = np.concatenate(chunks, axis=1).astype(np.float32)
        (self.frames,) = struct.unpack_from("<Q", data, at)
        if values.shape[1] != self.frames:
            raise ValueError(f"{path}: {values.shape[1]} frames, {self.frames} expected")
        self._values = dict(zip(columns, values))

    def __getitem__(self, column):
        return self._values[column]
