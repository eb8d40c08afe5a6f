/// An FMU of version 3.0 as an importer uses it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/fmi/binary/fmi3.hpp"
#include "tests/acceptance/fmu/importer/description.hpp"
#include "tests/acceptance/fmu/importer/shared_library.hpp"

namespace sonoglide::acceptance {

/// Its messages, one a line.
struct Messages {
  std::string text;
};

/// What a step came to.
struct Stepped {
  fmi3Status status;
  bool early;
  double time_s;
};

class Fmu3 {
 public:
  /// @param fmu  a folder of this name in `folder` has it unpacked
  Fmu3(const ScratchFolder& folder, const std::string& fmu);

  const Description& description() const { return description_; }
  const SharedLibrary& library() const { return library_; }
  const std::string& resources() const { return resources_; }

 private:
  Description description_;
  std::string resources_;
  SharedLibrary library_;
};

class Instance3 {
 public:
  /// @param token  empty: that of the description
  explicit Instance3(const Fmu3& fmu, bool early_return_allowed = false,
                     const std::string& token = "");
  ~Instance3();
  Instance3(const Instance3&) = delete;
  Instance3& operator=(const Instance3&) = delete;

  bool exists() const { return instance_ != nullptr; }
  const std::string& messages() const { return messages_.text; }

  void initialize(double start_s = 0.0);
  fmi3Status enter(double start_s = 0.0, std::optional<double> stop_s = std::nullopt);
  fmi3Status exit();
  fmi3Status set(const std::string& variable, double value);
  fmi3Status set(const std::string& variable, std::int32_t value);
  double real(const std::string& variable);
  float single(const std::string& variable);
  std::int32_t integer(const std::string& variable);
  std::string text(const std::string& variable);
  Stepped step(double point_s, double size_s);

  /// The state as bytes.
  std::vector<std::uint8_t> serialized_state();
  /// Restores it from bytes.
  void restore(const std::vector<std::uint8_t>& bytes);

  template <class Function>
  Function* call(const char* name) const {
    return fmu_.library().function<Function>(name);
  }
  fmi3Instance get() const { return instance_; }

 private:
  const Fmu3& fmu_;
  Messages messages_;
  fmi3Instance instance_;
};

/// The function of the interface by its name, as the library has it.
#define SONOGLIDE_CALL3(instance, name) (instance).call<decltype(name)>(#name)

}  // namespace sonoglide::acceptance
