#include "tests/acceptance/fmu/importer/fmu2.hpp"

#include <cstdarg>
#include <cstdio>

namespace sonoglide::acceptance {
namespace {

void note(fmi2ComponentEnvironment environment, fmi2String /*name*/, fmi2Status status,
          fmi2String category, fmi2String format, ...) {
  char message[1000];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(message, sizeof(message), format, arguments);
  va_end(arguments);
  *static_cast<std::string*>(environment) +=
      std::to_string(status) + " " + category + ": " + message + "\n";
}

/// As RFC 3986 escapes it: every byte.
std::string uri_of(const std::string& path) {
  std::string uri = "file://";
  for (const char each : path) {
    char escaped[4];
    std::snprintf(escaped, sizeof(escaped), "%%%02X", static_cast<unsigned char>(each));
    uri += each == '/' ? std::string("/") : std::string(escaped);
  }
  return uri;
}

}  // namespace

Fmu2::Fmu2(const ScratchFolder& folder, const std::string& fmu)
    : description_(folder, fmu),
      resources_(uri_of((folder.path() / fmu / "resources").string())),
      library_((folder.path() / fmu / "binaries/linux64").string() + "/" +
               description_.stepping("modelIdentifier") + ".so") {}

Instance2::Instance2(const Fmu2& fmu)
    : fmu_(fmu), callbacks_{note, nullptr, nullptr, nullptr, &messages_} {
  component_ = SONOGLIDE_CALL2(*this, fmi2Instantiate)("tested", fmi2CoSimulation,
                                                       fmu.description().attribute("guid").c_str(),
                                                       fmu.resources().c_str(), &callbacks_, 0, 1);
}

Instance2::~Instance2() {
  SONOGLIDE_CALL2(*this, fmi2FreeInstance)(component_);
}

void Instance2::initialize(double start_s) {
  if (component_ == nullptr ||
      SONOGLIDE_CALL2(*this, fmi2SetupExperiment)(component_, 0, 0.0, start_s, 0, 0.0) != fmi2OK ||
      SONOGLIDE_CALL2(*this, fmi2EnterInitializationMode)(component_) != fmi2OK ||
      SONOGLIDE_CALL2(*this, fmi2ExitInitializationMode)(component_) != fmi2OK) {
    throw std::runtime_error(messages_);
  }
}

fmi2Status Instance2::set(const std::string& variable, double value) {
  const unsigned reference = fmu_.description().reference(variable);
  return SONOGLIDE_CALL2(*this, fmi2SetReal)(component_, &reference, 1, &value);
}

double Instance2::real(const std::string& variable) {
  const unsigned reference = fmu_.description().reference(variable);
  double value = 0.0;
  if (SONOGLIDE_CALL2(*this, fmi2GetReal)(component_, &reference, 1, &value) != fmi2OK) {
    throw std::runtime_error(messages_);
  }
  return value;
}

int Instance2::integer(const std::string& variable) {
  const unsigned reference = fmu_.description().reference(variable);
  int value = 0;
  if (SONOGLIDE_CALL2(*this, fmi2GetInteger)(component_, &reference, 1, &value) != fmi2OK) {
    throw std::runtime_error(messages_);
  }
  return value;
}

std::string Instance2::text(const std::string& variable) {
  const unsigned reference = fmu_.description().reference(variable);
  const char* value = nullptr;
  if (SONOGLIDE_CALL2(*this, fmi2GetString)(component_, &reference, 1, &value) != fmi2OK) {
    throw std::runtime_error(messages_);
  }
  return value;
}

fmi2Status Instance2::step(double point_s, double size_s) {
  return SONOGLIDE_CALL2(*this, fmi2DoStep)(component_, point_s, size_s, 1);
}

}  // namespace sonoglide::acceptance
