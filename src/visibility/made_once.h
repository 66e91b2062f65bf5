#pragma once

#include <atomic>
#include <memory>
#include <mutex>

namespace facemap {

/// A part that is made when it is first needed, by whichever thread comes first; the others wait.
template <class Part>
class MadeOnce {
 public:
  /// `make()` returns a std::unique_ptr<Part>. If it throws, the next to come tries again.
  template <class Make>
  const Part& get(const Make& make) {
    if (const Part* made = part_.load(std::memory_order_acquire)) return *made;
    const std::scoped_lock lock(making_);
    if (owner_ == nullptr) {
      owner_ = make();
      part_.store(owner_.get(), std::memory_order_release);
    }
    return *owner_;
  }

  /// Null as long as it is not made.
  const Part* if_made() const { return part_.load(std::memory_order_acquire); }

 private:
  std::mutex making_;
  std::unique_ptr<const Part> owner_;
  std::atomic<const Part*> part_{nullptr};
};

}  // namespace facemap
