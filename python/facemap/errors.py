"""What facemap raises beside Python's own TypeError, ValueError and IndexError."""

from __future__ import annotations


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
