/// A line for each step of a controller: see write_trace.cpp.
#pragma once

#include <iostream>

#include "hal/board.hpp"

namespace sonoglide::boards_test {

inline void write_sample(const hal::Sample& sample) {
  std::cout << sample.friction_force << ' ' << sample.sliding_velocity << ' '
            << sample.force_at_rail << ' ' << sample.fresh << ' ' << sample.velocity_at_rail << ' ';
}

inline void write_answer(const hal::Drive& drive) {
  std::cout << drive.amplitude << ' ' << drive.commanded_ratio << ' ' << int{drive.state} << ' '
            << int{drive.limit} << ' ' << int{drive.fault} << ' ' << int{drive.settling};
}

inline void write_line(const hal::Sample& sample, const hal::Drive& drive) {
  write_sample(sample);
  write_answer(drive);
  std::cout << '\n';
}

inline void write_line(const hal::VibrationSample& sample, const hal::ResonantDrive& drive) {
  write_sample(sample);
  std::cout << sample.in_phase << ' ' << sample.quadrature << ' ';
  write_answer(drive);
  std::cout << ' ' << drive.frequency << '\n';
}

}  // namespace sonoglide::boards_test
