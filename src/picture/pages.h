#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <new>

namespace facemap {

/// An array of plain numbers without values to begin with. If it is large it stands on huge pages where the system
/// gives them: one that is written once is mostly page faults otherwise.
template <class Value>
class Pages {
 public:
  explicit Pages(std::size_t count) : bytes_(count * sizeof(Value)), alignment_(bytes_ < kHugePage ? 64 : kHugePage) {
    data_ = static_cast<Value*>(::operator new(bytes_, std::align_val_t(alignment_)));
#ifdef MADV_HUGEPAGE
    // The rest, below one huge page, is left to ordinary ones.
    if (bytes_ >= kHugePage) ::madvise(data_, bytes_ / kHugePage * kHugePage, MADV_HUGEPAGE);
#endif
  }
  ~Pages() { ::operator delete(data_, std::align_val_t(alignment_)); }
  Pages(const Pages&) = delete;
  Pages& operator=(const Pages&) = delete;

  Value* data() const noexcept { return data_; }

 private:
  static constexpr std::size_t kHugePage = std::size_t{1} << 21;

  std::size_t bytes_, alignment_;
  Value* data_ = nullptr;
};

}  // namespace facemap
