"""Results files that tests make or change with h5py: given the checksum that readers compare."""

import zlib
from pathlib import Path

from pounding.checked_file import BLOCK, block


def seal(path):
    """Makes an HDF5 file whole in the eyes of readers, as it stands."""
    content = Path(path).read_bytes()
    if content[:8] != b"\x89HDF\r\n\x1a\n":
        content = content[BLOCK:]
    Path(path).write_bytes(block(BLOCK + len(content), zlib.crc32(content)) + content)
