"""Results files that tests make or change with h5py, with the checksum expected by readers."""

import zlib
from pathlib import Path

from pounding._checked_file import BLOCK, block


def seal(path):
    """Writes the checksum of the current content of an HDF5 file."""
    content = Path(path).read_bytes()
    if content[:8] != b"\x89HDF\r\n\x1a\n":
        content = content[BLOCK:]
    Path(path).write_bytes(block(BLOCK + len(content), zlib.crc32(content)) + content)
