/// An FMU of version 2.0 as an importer uses it.
#pragma once

#include <string>

#include "host_sim/fmi/binary/fmi2.hpp"
#include "tests/acceptance/fmu/importer/description.hpp"
#include "tests/acceptance/fmu/importer/shared_library.hpp"

namespace sonoglide::acceptance {

class Fmu2 {
 public:
  /// @param fmu  a folder of this name in `folder` has it unpacked
  Fmu2(const ScratchFolder& folder, const std::string& fmu);

  const Description& description() const { return description_; }
  const SharedLibrary& library() const { return library_; }
  /// A URI.
  const std::string& resources() const { return resources_; }

 private:
  Description description_;
  std::string resources_;
  SharedLibrary library_;
};

class Instance2 {
 public:
  explicit Instance2(const Fmu2& fmu);
  ~Instance2();
  Instance2(const Instance2&) = delete;
  Instance2& operator=(const Instance2&) = delete;

  const std::string& messages() const { return messages_; }
  void initialize(double start_s = 0.0);
  fmi2Status set(const std::string& variable, double value);
  double real(const std::string& variable);
  int integer(const std::string& variable);
  std::string text(const std::string& variable);
  fmi2Status step(double point_s, double size_s);

  template <class Function>
  Function* call(const char* name) const {
    return fmu_.library().function<Function>(name);
  }
  fmi2Component get() const { return component_; }

 private:
  const Fmu2& fmu_;
  std::string messages_;
  fmi2CallbackFunctions callbacks_;
  fmi2Component component_;
};

#define SONOGLIDE_CALL2(instance, name) (instance).call<decltype(name)>(#name)

}  // namespace sonoglide::acceptance
