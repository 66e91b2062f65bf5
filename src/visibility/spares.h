#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace facemap {

/// Working memory for tasks of any threads: what one has done with serves the next.
template <class Memory>
class Spares {
 public:
  /// Memory that nobody else has until this is gone.
  class Loan {
   public:
    explicit Loan(Spares& from) : from_(from), memory_(from.take()) {}
    ~Loan() { from_.give_back(std::move(memory_)); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;

    Memory& operator*() const { return *memory_; }
    Memory* operator->() const { return memory_.get(); }

   private:
    Spares& from_;
    std::unique_ptr<Memory> memory_;
  };

  /// Bytes of what is not in use.
  std::size_t memory_bytes() const {
    const std::scoped_lock lock(mutex_);
    std::size_t bytes = 0;
    for (const auto& memory : spare_) bytes += memory->memory_bytes();
    return bytes;
  }

 private:
  std::unique_ptr<Memory> take() {
    const std::scoped_lock lock(mutex_);
    if (spare_.empty()) {
      spare_.reserve(++made_);  // so that giving back never needs memory
      return std::make_unique<Memory>();
    }
    std::unique_ptr<Memory> memory = std::move(spare_.back());
    spare_.pop_back();
    return memory;
  }
  void give_back(std::unique_ptr<Memory> memory) noexcept {
    const std::scoped_lock lock(mutex_);
    spare_.push_back(std::move(memory));
  }

  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<Memory>> spare_;
  std::size_t made_ = 0;
};

}  // namespace facemap
