/// A pipe that no other program inherits by accident.
#pragma once

#include "host_sim/process/descriptor.hpp"

namespace sonoglide::process {

struct Pipe {
  Descriptor read_end;
  Descriptor write_end;
};

/// @throws ProcessError  no descriptors are left
Pipe make_pipe();

}  // namespace sonoglide::process
