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

class SnapshotWriter {
 public:
  /// @param value  holds no address of what may be elsewhere when the bytes are read
  template <class Value>
  void put(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    const auto* begin = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), begin, begin + sizeof(Value));
  }

  Snapshot take() { return std::move(bytes_); }

 private:
  Snapshot bytes_;
};

/// Takes the values in the order in which they were put.
class SnapshotReader {
 public:
  /// @param bytes  outlive the reader
  explicit SnapshotReader(const Snapshot& bytes) : bytes_(bytes) {}

  /// @throws std::invalid_argument  there are not as many bytes left
  template <class Value>
  void get(Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    if (bytes_.size() - next_ < sizeof(Value)) {
      throw std::invalid_argument("the state that is to be restored is too short");
    }
    std::memcpy(static_cast<void*>(&value), bytes_.data() + next_, sizeof(Value));
    next_ += sizeof(Value);
  }

  bool over() const { return next_ == bytes_.size(); }

 private:
  const Snapshot& bytes_;
  std::size_t next_ = 0;
};

}  // namespace sonoglide::loop
