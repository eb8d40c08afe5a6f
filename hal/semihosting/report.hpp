/// Lines of text for the person or program that runs the image.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/semihosting/semihosting.hpp"

namespace sonoglide::hal::semihosting {

/// Writes "name value" lines to the emulator's or the debugger's standard output.
class Report {
 public:
  /// The value in decimal figures. Names have up to 40 characters.
  void number(const char* name, std::uint64_t value);
  /// The value in 16 hexadecimal figures.
  void hash(const char* name, std::uint64_t value);

  /// Whether every line was taken.
  bool complete() const { return complete_; }

 private:
  using Figures = std::array<char, 20>;  // of 2^64 - 1

  void line(const char* name, const Figures& figures, std::size_t count);

  std::int32_t output_ = open_standard_output();
  bool complete_ = output_ >= 0;
};

}  // namespace sonoglide::hal::semihosting
