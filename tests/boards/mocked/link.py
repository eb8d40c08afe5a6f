"""The host's end of the framed link (firmware/link/README.md)."""
import struct
import zlib

VERSION = 2
TELEMETRY, TARGET, READ_PARAMETER, WRITE_PARAMETER, RESTART, STOP, READ_HISTORY = 1, 2, 3, 4, 5, 6, 17
REFUSED = 0xFF
ANSWER = 0x80


def stuffed(content):
    return b"\0" + b"".join(bytes([len(block) + 1]) + block for block in content.split(b"\0")) + b"\0"


def unstuffed(wire):
    content, at = b"", 0
    while at < len(wire):
        content += wire[at + 1:at + wire[at]]
        at += wire[at]
        content += b"\0" if at < len(wire) else b""
    return content


class Link:
    """board: hears and sends bytes; advance(): lets it run for a while."""

    def __init__(self, board, advance):
        self.board, self.advance, self.sequence = board, advance, 0

    def ask(self, kind, payload=b""):
        """Whether it was refused, and the payload of the answer."""
        self.sequence += 1
        content = struct.pack("<BBH", VERSION, kind, self.sequence) + payload
        self.board.sent.clear()
        self.board.hear(stuffed(content + struct.pack("<I", zlib.crc32(content))))
        for _ in range(3000):
            self.advance()
            *frames, _ = bytes(self.board.sent).split(b"\0")
            frames = [frame for frame in frames if frame]
            if frames:
                return self.answer(unstuffed(frames[0]), kind)
        raise AssertionError(f"request {kind} is not answered")

    def answer(self, frame, kind):
        content, (checksum,) = frame[:-4], struct.unpack("<I", frame[-4:])
        version, answered, sequence = struct.unpack_from("<BBH", content)
        assert (version, sequence, checksum) == (VERSION, self.sequence, zlib.crc32(content))
        assert answered in (kind | ANSWER, REFUSED)
        return answered == REFUSED, content[4:]

    def telemetry(self):
        payload = self.ask(TELEMETRY)[1]
        period, force, velocity, amplitude, target = struct.unpack_from("<5i", payload)
        return {"state": payload[20], "fault": payload[22], "parameters": payload[23], "amplitude": amplitude,
                "target": target, "force": force, "velocity": velocity, "period": period}
