"""Exceptions: what the library's status codes mean, and what the readers of case folders raise."""

from __future__ import annotations

from typing import NoReturn


class MsddError(Exception):
    """Whatever went wrong in MSDD; its text is the library's. `status` is the code of `enum msdd_status`, 0 if the failure
    did not come from the library."""

    status = 0


class InvalidArgument(MsddError, ValueError):
    """An argument outside its allowed range; the text names it, its value and the range."""

    status = 1


class FileError(MsddError, OSError):
    """A file could not be read or written."""

    status = 2


class ModelError(MsddError, ValueError):
    """A model file is damaged, of another schema, or inconsistent."""

    status = 3


class NonFinite(MsddError, ValueError):
    """A column holds NaN or infinity; the text names column and index."""

    status = 4


class RveError(MsddError, RuntimeError):
    """A box could not be packed or strained; or a state, plan or database is not one."""

    status = 5


class PluginError(MsddError, RuntimeError):
    """A plug-in could not be loaded, failed, or gave an answer that no packing of grains has."""

    status = 7


class InternalError(MsddError, RuntimeError):
    """A bug in the library."""

    status = 255


class CaseError(MsddError, ValueError):
    """A file of a case is missing or cannot be read as what it should be; the text names it."""


_BY_STATUS = {
    kind.status: kind
    for kind in (InvalidArgument, FileError, ModelError, NonFinite, RveError, PluginError, InternalError)
}


def raise_for(status: int, text: str) -> NoReturn:
    """Raises the exception of a status of the library."""
    error = _BY_STATUS.get(status, MsddError)(text)
    error.status = status
    raise error
