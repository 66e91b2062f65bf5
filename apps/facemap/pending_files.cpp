#include "pending_files.h"

#include "output.h"

namespace facemap::program {

PendingFiles::Pending::Pending(const std::filesystem::path& path) : file(path) {
  if (!file.temporary().empty()) removed.emplace(file.temporary());
}

void PendingFiles::add(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  if (is_standard_output(path)) return write_to_standard_output(bytes);
  hold_signals([&] { files_.emplace_back(path); });
  AtomicFile& file = files_.back().file;
  file.write(bytes.data(), bytes.size());
  file.finish();
}

void PendingFiles::commit() {
  hold_signals([&] {
    for (Pending& pending : files_) pending.file.commit();
    files_.clear();
  });
}

void write_output(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  PendingFiles files;
  files.add(path, bytes);
  files.commit();
}

}  // namespace facemap::program
