/// Arguments that have a range.
#pragma once

#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <string>

#include "host_sim/process/thread_limit.hpp"

namespace sonoglide::python {

/// @param given, allowed  of an argument; `is_allowed` is false: it is refused
template <class Given>
void require(bool is_allowed, const char* name, const Given& given, const std::string& allowed) {
  if (!is_allowed) {
    throw pybind11::value_error(fmt::format("{} is {}; allowed: {}", name, given, allowed));
  }
}

/// An integer of Python or of NumPy, however large.
/// @throws pybind11::value_error  out of range
/// @throws pybind11::error_already_set  TypeError: no integer
inline std::uint64_t integer(const pybind11::object& given, const char* name, std::uint64_t least,
                             std::uint64_t most) {
  const auto number = pybind11::reinterpret_steal<pybind11::int_>(PyNumber_Index(given.ptr()));
  if (!number) {
    throw pybind11::error_already_set();
  }
  const bool is_allowed = pybind11::int_(least) <= number && number <= pybind11::int_(most);
  require(is_allowed, name, std::string(pybind11::repr(number)),
          fmt::format("{} to {}", least, most));
  return number.cast<std::uint64_t>();
}

/// 0: one for each core.
inline unsigned thread_limit(const pybind11::object& given) {
  return static_cast<unsigned>(integer(given, "threads", 0, process::most_threads));
}

/// As `sensor.seed` and `--seed` allow.
inline std::uint64_t seed_of(const pybind11::object& given) {
  return integer(given, "seed", 0, INT64_MAX);
}

}  // namespace sonoglide::python
