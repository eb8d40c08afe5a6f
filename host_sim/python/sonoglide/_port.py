"""A unit at a serial device."""

from __future__ import annotations

import os

from . import _core


class Port(_core.Port):
    """A running unit (sonoglide image) at the other end of a serial line, as sonoglide connect talks to it.
    The unit takes its host for silent after its parameter host_timeout: a program that drives asks for
    status() more often than that. Several threads may use a port; their requests take turns. Forces are in
    newtons, as all is in SI units; where holds_force, so is the target.

    device      path of the serial device; 115200 baud
    patience_s  how long an answer may take before the request is sent again, twice

    One port or program at a time has a device: close() frees it, and so does the end of
    `with Port(...) as unit:`.

    OSError: the device is absent, silent or no unit, or the port is closed. ValueError: a value that the
    unit does not have; the message has its range. RuntimeError: the unit refuses the request as things
    are, and says why.
    """

    def __init__(self, device: str | os.PathLike[str], patience_s: float = 0.4) -> None:
        self.device = os.fspath(device)
        super().__init__(self.device, patience_s)

    def __enter__(self) -> Port:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def parameters(self) -> dict[str, dict[str, float]]:
        """Every parameter by its name, see parameter()."""
        return {name: self.parameter(name) for name in _core.parameter_names}

    def __repr__(self) -> str:
        return f"<sonoglide.Port at {self.device}>"
