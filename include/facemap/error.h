#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace facemap {

/// What the library throws for bad input. It never prints, aborts or exits.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that cannot be read. what() is "file:line: reason", "file:line:column: reason" where the column is known, or
/// "file: reason" where no line is to blame.
class LoadError : public Error {
 public:
  /// One value per cause, so that a caller can ask for the cause and not for the wording.
  enum class Cause {
    CannotOpen,
    UnknownFormat,
    BadNumber,
    BadIndex,
    TruncatedStatement,
    NoFaces,
    TooLarge,
    BadEncoding,
    BadImage,     ///< a picture that cannot be decoded
    BadSyntax,    ///< not well-formed
    BadValue,     ///< a value of the wrong type or out of its range, or none where there must be one
    Unsupported,  ///< well-formed, but not read: another version, a required extension
    NotAllowed,   ///< names a file outside the model's folder
  };

  /// `line` and `column` count from 1; 0 means that no line is to blame, or that the column is not known.
  LoadError(Cause cause, const std::string& file, std::int64_t line, const std::string& reason,
            std::int64_t column = 0);

  Cause cause() const noexcept { return cause_; }
  const std::string& file() const noexcept { return file_; }
  std::int64_t line() const noexcept { return line_; }
  std::int64_t column() const noexcept { return column_; }
  const std::string& reason() const noexcept { return reason_; }

 private:
  Cause cause_;
  std::string file_;
  std::int64_t line_, column_;
  std::string reason_;
};

}  // namespace facemap
