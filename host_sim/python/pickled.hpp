/// States of the simulation as Python pickles and copies them.
#pragma once

#include <pybind11/pybind11.h>

#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

#include "host_sim/loop/plant/snapshot.hpp"
#include "host_sim/process/checksum.hpp"

namespace sonoglide::python {

/// The parts of a state, with a checksum, for one that is damaged must not be gone on from.
/// @param copy_state  copies them
template <class CopyState>
pybind11::bytes pickled(const CopyState& copy_state) {
  loop::StateCopy copy;
  copy_state(copy);
  const loop::Snapshot state = copy.take();
  std::string bytes(reinterpret_cast<const char*>(state.data()), state.size());
  const std::uint64_t sum = process::checksum(bytes);
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof(sum));
  return bytes;
}

/// @param copy_state  copies the parts
/// @throws std::invalid_argument  they are damaged, or not those
template <class CopyState>
void unpickle(const pybind11::bytes& pickled, const CopyState& copy_state) {
  const std::string bytes = pickled;
  std::uint64_t sum = 0;
  if (bytes.size() < sizeof(sum)) {
    throw std::invalid_argument("the pickled state is too short");
  }
  const std::size_t size = bytes.size() - sizeof(sum);
  std::memcpy(&sum, bytes.data() + size, sizeof(sum));
  if (sum != process::checksum(std::string_view(bytes).substr(0, size))) {
    throw std::invalid_argument("the pickled state is damaged");
  }
  loop::Snapshot state(size);
  std::memcpy(state.data(), bytes.data(), size);
  loop::StateCopy copy(state);
  copy_state(copy);
  if (!copy.over()) {
    throw std::invalid_argument("the state that is to be restored is too long");
  }
}

}  // namespace sonoglide::python
