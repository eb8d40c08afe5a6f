/// What a part of the controller is called in the code of an image.
#pragma once

namespace sonoglide::control {

/// How a part is named in a written header.
struct PartName {
  const char* header;  ///< in firmware/control, without .hpp
  const char* type;    ///< without what the template is told
};

}  // namespace sonoglide::control
