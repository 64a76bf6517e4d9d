"""A gap link for the element genericClient of OpenSees, in a process started by `pounding.opensees.link`.

python3 link_process.py reads one line of JSON, writes {"port": ...}, serves one element

OpenSees holds the interpreter while it computes, so the link needs its own process. The element requests force and
slopes at trial states of Newton's method and commits states; impacts begin, continue and end at committed states.
Protocol: GenericClient.cpp and RemoteTest in the sources of OpenSees. Uses only the standard library and the C
interface of the laws (pounding.h). Errors do not end the process, for which OpenSees would wait forever: the link
returns NaN, which ends the analysis, and reports the message on request."""

from __future__ import annotations

import contextlib
import ctypes
import json
import math
import os
import select
import socket
import struct
import sys
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

LIBRARY = Path(__file__).parents[1] / "libpounding_c.so.1"

# First number of a message from the element. An answer is a vector of the same size.
SET_TRIAL, COMMIT, GET_FORCE, GET_STIFFNESS, GET_DAMPING, END = 3, 5, 10, 13, 14, 99


class _Contact(ctypes.Structure):
    """pnd_contact."""

    _fields_ = [
        (name, ctypes.c_double)
        for name in ("touching", "indentation", "closing_speed", "damping", "largest_penetration", "slip", "crushed")
    ] + [("reserved", ctypes.c_double * 1)]


class _Value(ctypes.Structure):
    """pnd_value."""

    _fields_ = [("name", ctypes.c_char_p), ("value", ctypes.c_double)]


class Answer(ctypes.Structure):
    """pnd_response: force > 0 pushes apart [N], its slopes by penetration [N/m] and by rate [N s/m]."""

    _fields_ = [(name, ctypes.c_double) for name in ("force", "by_penetration", "by_rate")]


class Law:
    """A law of the C interface. Raises ValueError with the message of the interface."""

    def __init__(self, name: str, formula: str, values: dict[str, float]) -> None:
        self._library = ctypes.CDLL(str(LIBRARY))
        self._library.pnd_error_text.restype = ctypes.c_char_p
        self._law = ctypes.c_void_p()
        pairs = (_Value * len(values))(*(_Value(name.encode(), value) for name, value in values.items()))
        count, law = ctypes.c_size_t(len(values)), ctypes.byref(self._law)
        self._check(self._library.pnd_create(name.encode(), formula.encode(), pairs, count, law))

    def touch(self, contact: _Contact, closing_speed: float) -> None:
        """Marks the start of contact at this closing speed [m/s]."""
        self._check(self._library.pnd_touch(self._law, ctypes.c_double(closing_speed), ctypes.byref(contact)))

    def respond(self, contact: _Contact, penetration: float, rate: float) -> Answer:
        """Force [N] and both slopes at a penetration [m] and its rate [m/s]. Pure."""
        answer, state = Answer(), (ctypes.c_double(penetration), ctypes.c_double(rate))
        self._check(self._library.pnd_respond(self._law, ctypes.byref(contact), *state, ctypes.byref(answer)))
        return answer

    def accept(self, contact: _Contact, penetration: float, rate: float) -> None:
        """Accepts the state at the end of a committed step."""
        state = ctypes.c_double(penetration), ctypes.c_double(rate)
        self._check(self._library.pnd_accept(self._law, *state, ctypes.byref(contact)))

    def _check(self, status: int) -> None:
        if status != 0:
            raise ValueError(self._library.pnd_error_text().decode())


@dataclass
class Impact:
    """A row of /impacts in results files; peaks are maxima at committed states."""

    t_start: float  #: touch, located inside its step [s]
    t_end: float  #: separation, located inside its step; NaN while the impact lasts [s]
    v_approach: float  #: closing speed at the touch [m/s]
    v_separation: float = math.nan  #: opening speed at the separation [m/s]
    restitution: float = math.nan  #: obtained: v_separation / v_approach
    peak_force: float = 0.0  #: [N]
    t_peak: float = math.nan  #: time of the peak force [s]
    peak_penetration: float = 0.0  #: [m]
    impulse: float = 0.0  #: integral of the force [N s]
    energy_lost: float = 0.0  #: dissipated work [J]
    energy_stored: float = 0.0  #: recoverable energy of an unfinished contact [J]


class State(NamedTuple):
    """Relative motion; penetration > 0 is overlap, rate > 0 closes."""

    time: float  #: [s]
    penetration: float  #: [m]
    rate: float  #: [m/s]
    acceleration: float  #: [m/s^2]


def time_to_close(opening: float, rate: float, acceleration: float) -> float:
    """Time until opening >= 0 closes at this rate and acceleration: the first root of opening = rate s + acceleration
    s^2/2; infinite if there is none."""
    under_root = rate * rate + 2 * acceleration * opening
    if under_root < 0:
        return math.inf
    # Without cancellation, and for any sign of the acceleration.
    divisor = rate + math.sqrt(under_root)
    return 2 * opening / divisor if divisor > 0 else 0.0 if opening == 0 else math.inf


class Link:
    """Force at trial states, and history at committed states.

    An impact begins at the first committed state with overlap, so that one formula of the force applies to a whole
    step: if the force jumps at contact, as for kelvin_voigt, a step could otherwise have no solution. The closing speed
    is that at contact within the step, from the acceleration at its beginning."""

    def __init__(self, law: Law, gap: float) -> None:
        self.law, self.gap = law, gap
        self.impacts: list[Impact] = []
        self.contact = _Contact()
        self.kept: State | None = None
        self.now = State(0.0, -gap, 0.0, 0.0)
        self.answer = Answer()
        self.force = 0.0  # of the link in the kept state, as the solver had it

    def trial(self, time: float, closure: float, rate: float, acceleration: float) -> Answer:
        """Response at a trial state, which `keep` may commit."""
        self.now = State(time, closure - self.gap, rate, acceleration)
        # The model as it is before its first step.
        self.kept = self.kept or self.now
        self.answer = self.law.respond(self.contact, self.now.penetration, self.now.rate)
        return self.answer

    def keep(self) -> None:
        """Commits the last trial state."""
        before, now = self.kept or self.now, self.now
        indentation, was_touching = self.contact.indentation, bool(self.contact.touching)
        if not was_touching and now.penetration > indentation:
            wait = time_to_close(max(0.0, indentation - before.penetration), before.rate, before.acceleration)
            start = min(before.time + wait, now.time)
            speed = max(0.0, before.rate + before.acceleration * (start - before.time))
            self.law.touch(self.contact, speed)
            self.impacts.append(Impact(start, math.nan, speed))
        if self.contact.touching:
            self.law.accept(self.contact, now.penetration, now.rate)
            self._add(before, now, indentation)
            if not self.contact.touching:
                self._end(now, indentation)
        self.kept, self.force = now, self.answer.force

    def rows(self) -> list[Impact]:
        """All impacts; the work of an unfinished one is split into lost and stored energy."""
        if not self.contact.touching or not self.kept or self.force == 0:
            return self.impacts
        *over, last = self.impacts
        # The energy recovered in a slow separation, to 1e-5.
        deep, parts = self.kept.penetration, [(i + 0.5) / 200 for i in range(200)]
        stored = sum(2 * t * self.law.respond(self.contact, deep * t * t, 0.0).force for t in parts) * deep / 200
        return [*over, replace(last, energy_stored=stored, energy_lost=last.energy_lost - stored)]

    def _add(self, before: State, now: State, indentation: float) -> None:
        row, force, step = self.impacts[-1], self.answer.force, now.time - before.time
        row.impulse += 0.5 * step * (self.force + force)
        row.energy_lost += 0.5 * step * (self.force * before.rate + force * now.rate)
        row.peak_penetration = max(row.peak_penetration, now.penetration - indentation)
        if force > row.peak_force:
            row.peak_force, row.t_peak = force, now.time

    def _end(self, now: State, indentation: float) -> None:
        """Locates the separation within the step, backwards in time from the open state without contact force."""
        row = self.impacts[-1]
        back = time_to_close(max(0.0, indentation - now.penetration), -now.rate, now.acceleration)
        back = back if math.isfinite(back) else 0.0
        row.t_end, row.v_separation = now.time - back, -now.rate + now.acceleration * back
        row.restitution = row.v_separation / row.v_approach if row.v_approach > 0 else math.nan


class Server:
    """Serves one link to one element with two unknowns, of the left and the right body along the line between
    them."""

    def __init__(self, link: Link) -> None:
        self.link = link
        self.error = ""
        self.answer = Answer()
        self.connected = False

    def serve(self, connection: socket.socket) -> None:
        """Serves until the element ends; `sys.stdin` may request results meanwhile."""
        head = self._read(connection, 44)
        if not head:
            return
        self.connected = True
        sizes = struct.unpack("11i", head)
        vector = struct.Struct(f"{sizes[10]}d")
        listening = [connection, sys.stdin]
        while True:
            ready = select.select(listening, [], [])[0]
            # Read the element first: its data precede the request.
            if connection in ready:
                data = self._read(connection, vector.size)
                if not data:
                    return
                numbers = vector.unpack(data)
                if numbers[0] == END:
                    return
                answer = self._answer(numbers)
                if answer is not None:
                    connection.sendall(vector.pack(*answer, *[0.0] * (sizes[10] - 4)))
            elif not sys.stdin.readline():
                listening.remove(sys.stdin)
            else:
                self.tell()

    def tell(self) -> None:
        """Writes error, connection and impacts as a line of JSON to the caller."""
        answer = {
            "error": self.error,
            "connected": self.connected,
            "impacts": [asdict(impact) for impact in self.link.rows()],
        }
        # The caller may be gone.
        with contextlib.suppress(BrokenPipeError):
            os.write(sys.stdout.fileno(), (json.dumps(answer) + "\n").encode())

    def _answer(self, numbers: tuple[float, ...]) -> tuple[float, float, float, float] | None:
        action, link = numbers[0], self.link
        try:
            if action == SET_TRIAL:
                u1, u2, v1, v2, a1, a2, time = numbers[1:8]
                self.answer = Answer(math.nan, math.nan, math.nan)
                self.answer = link.trial(time, u1 - u2, v1 - v2, a1 - a2)
                return None
            if action == COMMIT:
                link.keep()
                self.error = ""
                return None
        except ValueError as error:
            self.error = str(error)
            return None
        if action == GET_FORCE:
            # The element adds the damping matrix times the velocities.
            force = self.answer.force - self.answer.by_rate * link.now.rate
            return force, -force, 0.0, 0.0
        slope = {GET_STIFFNESS: self.answer.by_penetration, GET_DAMPING: self.answer.by_rate}.get(int(action), 0.0)
        return slope, -slope, -slope, slope

    @staticmethod
    def _read(connection: socket.socket, size: int) -> bytes:
        """Bytes from the element; empty after its end."""
        data = b""
        with contextlib.suppress(ConnectionError):
            while len(data) < size:
                part = connection.recv(size - len(data))
                # The element waits with its next message until this one is acknowledged, which else takes 40 ms. The
                # option is forgotten now and then.
                if hasattr(socket, "TCP_QUICKACK"):
                    connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_QUICKACK, 1)
                if not part:
                    return b""
                data += part
            return data
        return b""


def main() -> int:
    """Serves the link described by a line of JSON on standard input. Returns 2 for an invalid link."""
    asked: dict[str, Any] = json.loads(sys.stdin.readline())
    try:
        server = Server(Link(Law(asked["law"], asked["formula"], asked["values"]), asked["gap"]))
    except (OSError, ValueError) as error:
        print(json.dumps({"error": str(error)}), flush=True)
        return 2
    with socket.create_server(("127.0.0.1", 0)) as listener:
        print(json.dumps({"port": listener.getsockname()[1]}), flush=True)
        # The caller may end, or request results, before the element connects.
        while listener not in select.select([listener, sys.stdin], [], [])[0]:
            if not sys.stdin.readline():
                return 0
            server.tell()
        connection = listener.accept()[0]
    with connection:
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        server.serve(connection)
    server.tell()
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
