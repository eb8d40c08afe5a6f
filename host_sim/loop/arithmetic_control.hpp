/// The controllers of one arithmetic.
#pragma once

#include <memory>

#include "host_sim/configure/control_design.hpp"
#include "host_sim/loop/control_port.hpp"

namespace sonoglide::loop {

/// Defined in compose_control.hpp. Each arithmetic has a translation unit of its own, which CMake
/// makes of arithmetic_control.cpp.in: they take long to compile.
template <class Scalar>
std::unique_ptr<ControlPort> make_control(const configure::ControlDesign& design);

}  // namespace sonoglide::loop
