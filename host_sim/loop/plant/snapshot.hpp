/// The state of a simulation as bytes, from which it goes on bit for bit.
#pragma once

#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace sonoglide::loop {

/// As the machine holds it: bytes are of use to the build that wrote them.
using Snapshot = std::vector<std::byte>;

/// Copies what a state is made of into bytes, or back from them, in one order for both.
class StateCopy {
 public:
  /// Into bytes.
  StateCopy() = default;
  /// Back. @param bytes  outlive this
  explicit StateCopy(const Snapshot& bytes) : source_(&bytes) {}

  bool is_back() const { return source_ != nullptr; }

  /// @param values  hold no address of what may be elsewhere when they are copied back; constant ones
  ///                are copied into bytes alone
  /// @throws std::invalid_argument  there are not as many bytes left
  template <class... Values>
  void operator()(Values&... values) {
    (copy(values), ...);
  }

  /// What was copied into bytes.
  Snapshot take() { return std::move(bytes_); }
  /// All bytes have been copied back.
  bool over() const { return next_ == source_->size(); }

 private:
  template <class Value>
  void copy(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    const auto* begin = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), begin, begin + sizeof(Value));
  }
  template <class Value>
  void copy(Value& value) {
    if (!is_back()) {
      copy(std::as_const(value));
      return;
    }
    if (source_->size() - next_ < sizeof(Value)) {
      throw std::invalid_argument("the state that is to be restored is too short");
    }
    std::memcpy(static_cast<void*>(&value), source_->data() + next_, sizeof(Value));
    next_ += sizeof(Value);
  }

  const Snapshot* source_ = nullptr;
  std::size_t next_ = 0;  ///< of the source
  Snapshot bytes_;
};

}  // namespace sonoglide::loop
