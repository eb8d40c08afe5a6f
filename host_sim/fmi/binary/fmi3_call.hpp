/// How a function of FMI 3.0 calls its instance.
#pragma once

#include <cstddef>
#include <string>

#include "host_sim/fmi/binary/component.hpp"
#include "host_sim/fmi/binary/fmi3.hpp"

namespace sonoglide::fmi {

inline fmi3Status status_of_3(Status status) {
  return static_cast<fmi3Status>(status);
}

template <class Call>
fmi3Status attempt(fmi3Instance instance, const Call& call) {
  return instance == nullptr ? fmi3Error
                             : status_of_3(static_cast<Component*>(instance)->attempt(call));
}

inline Log log_of(fmi3InstanceEnvironment environment, fmi3LogMessageCallback log) {
  if (log == nullptr) {
    return {};
  }
  return [environment, log](Status status, const char* category, const std::string& message) {
    log(environment, status_of_3(status), category, message.c_str());
  };
}

}  // namespace sonoglide::fmi
