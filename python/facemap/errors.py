"""What facemap raises beside Python's own TypeError, ValueError and IndexError."""

from __future__ import annotations

import errno
import os


class Error(ValueError):
    """Something was asked of the library that cannot be: a value out of range, a file that cannot be written."""


class LoadError(Error):
    """A file that cannot be read.

    Attributes
    ----------
    file : str
        The file's name.
    line, column : int
        Where it went wrong, from 1; 0 if no line is to blame or the column is not known.
    reason : str
        What is wrong there. The whole message is "file:line:column: reason".
    """

    def __init__(self, message: str, file: str = "", line: int = 0, column: int = 0, reason: str = "") -> None:
        super().__init__(message, file, line, column, reason)
        self.file = file
        self.line = line
        self.column = column
        self.reason = reason

    def __str__(self) -> str:
        return str(self.args[0])


class OpenError(LoadError, OSError):
    """A file that is not there or cannot be opened, or one that it names: an OSError too.

    Attributes
    ----------
    filename : str
        As `file`.
    errno : int or None
        As of ``OSError``: ``errno.ENOENT`` for a file that is not there; None if it is not known.
    """

    def __init__(self, message: str, file: str = "", line: int = 0, column: int = 0, reason: str = "") -> None:
        super().__init__(message, file, line, column, reason)
        self.filename = file
        self.strerror = reason
        self.errno = next((number for number in errno.errorcode if os.strerror(number) == reason), None)
