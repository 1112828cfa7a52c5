"""How large a picture is, so that a page does not jump when it arrives."""
import re
import struct


def size(path):
    """{"width": ..., "height": ...} of a PNG, WebP or SVG; nothing of what is no such file."""
    if path is None:
        return {}
    head = path.read_bytes()[:2000]
    if head[:8] == b"\x89PNG\r\n\x1a\n":
        width, height = struct.unpack(">II", head[16:24])
    elif head[8:16] == b"WEBPVP8 ":
        width, height = (side & 0x3FFF for side in struct.unpack("<HH", head[26:30]))
    elif head[8:16] == b"WEBPVP8L":
        bits = int.from_bytes(head[21:25], "little")
        width, height = (bits & 0x3FFF) + 1, (bits >> 14 & 0x3FFF) + 1
    elif box := re.search(rb'viewBox="0 0 (\d+) (\d+)"', head):
        width, height = int(box[1]), int(box[2])
    else:
        return {}
    return {"width": str(width), "height": str(height)}
