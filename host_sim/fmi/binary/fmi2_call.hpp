/// How a function of FMI 2.0 calls its instance.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "host_sim/fmi/binary/component.hpp"
#include "host_sim/fmi/binary/fmi2.hpp"

namespace sonoglide::fmi {

/// What this version of the interface asks for besides.
struct Component2 {
  std::unique_ptr<Component> component;
  double start_s = 0.0;
};

inline constexpr const char* model_exchange = "model exchange";

inline fmi2Status status_of_2(Status status) {
  return static_cast<fmi2Status>(status);
}

template <class Call>
fmi2Status attempt(fmi2Component component, const Call& call) {
  return component == nullptr
             ? fmi2Error
             : status_of_2(static_cast<Component2*>(component)->component->attempt(call));
}

inline fmi2Status refused(fmi2Component component, const char* what) {
  return attempt(component, [what](const Instance& /*each*/) { refuse(what); });
}

inline Log log_of(fmi2String name, const fmi2CallbackFunctions* functions) {
  if (functions == nullptr || functions->logger == nullptr) {
    return {};
  }
  return [environment = functions->componentEnvironment, logger = functions->logger,
          called = std::string(name == nullptr ? "" : name)](Status status, const char* category,
                                                             const std::string& message) {
    logger(environment, called.c_str(), status_of_2(status), category, "%s", message.c_str());
  };
}

}  // namespace sonoglide::fmi
