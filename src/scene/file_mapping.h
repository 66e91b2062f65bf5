#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace facemap {

/// The bytes of a file: mapped into memory if it is a regular file, read if it is anything else (a pipe).
/// A file that is cut short by others while it is mapped ends the process (SIGBUS); nobody can read it safely.
class FileMapping {
 public:
  /// Throws LoadError: CannotOpen (directories too), TooLarge if there are more than `max_bytes`.
  FileMapping(const std::filesystem::path& path, std::uint64_t max_bytes);
  ~FileMapping();
  FileMapping(const FileMapping&) = delete;
  FileMapping& operator=(const FileMapping&) = delete;

  /// Valid as long as this object.
  std::string_view text() const noexcept { return text_; }

  /// Gives back the memory of a part of the text that will hardly be read again; it stays valid.
  void release(std::string_view part) const noexcept;

 private:
  void map(int descriptor, std::uint64_t size, const std::string& name);
  void read(int descriptor, std::uint64_t max_bytes, const std::string& name);

  void* mapped_ = nullptr;  ///< owned, if not null
  std::string read_;        ///< of what cannot be mapped
  std::string_view text_;
};

}  // namespace facemap
