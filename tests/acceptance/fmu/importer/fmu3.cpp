#include "tests/acceptance/fmu/importer/fmu3.hpp"

namespace sonoglide::acceptance {
namespace {

void note(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
          fmi3String message) {
  static_cast<Messages*>(environment)->text +=
      std::to_string(status) + " " + category + ": " + message + "\n";
}

std::string library_of(const std::string& folder, const Description& description) {
  return folder + "/binaries/" SONOGLIDE_PROCESSOR "-linux/" +
         description.stepping("modelIdentifier") + ".so";
}

}  // namespace

Fmu3::Fmu3(const ScratchFolder& folder, const std::string& fmu)
    : description_(folder, fmu),
      resources_((folder.path() / fmu / "resources/").string()),
      library_(library_of((folder.path() / fmu).string(), description_)) {}

Instance3::Instance3(const Fmu3& fmu, bool early_return_allowed, const std::string& token)
    : fmu_(fmu) {
  const std::string shown =
      token.empty() ? fmu.description().attribute("instantiationToken") : token;
  instance_ = SONOGLIDE_CALL3(*this, fmi3InstantiateCoSimulation)(
      "tested", shown.c_str(), fmu.resources().c_str(), false, true, false, early_return_allowed,
      nullptr, 0, &messages_, note, nullptr);
}

Instance3::~Instance3() {
  SONOGLIDE_CALL3(*this, fmi3FreeInstance)(instance_);
}

fmi3Status Instance3::enter(double start_s, std::optional<double> stop_s) {
  return SONOGLIDE_CALL3(*this, fmi3EnterInitializationMode)(
      instance_, false, 0.0, start_s, stop_s.has_value(), stop_s.value_or(0.0));
}

fmi3Status Instance3::exit() {
  return SONOGLIDE_CALL3(*this, fmi3ExitInitializationMode)(instance_);
}

void Instance3::initialize(double start_s) {
  if (!exists() || enter(start_s) != fmi3OK || exit() != fmi3OK) {
    throw std::runtime_error(messages());
  }
}

fmi3Status Instance3::set(const std::string& variable, double value) {
  const unsigned reference = fmu_.description().reference(variable);
  return SONOGLIDE_CALL3(*this, fmi3SetFloat64)(instance_, &reference, 1, &value, 1);
}

fmi3Status Instance3::set(const std::string& variable, std::int32_t value) {
  const unsigned reference = fmu_.description().reference(variable);
  return SONOGLIDE_CALL3(*this, fmi3SetInt32)(instance_, &reference, 1, &value, 1);
}

double Instance3::real(const std::string& variable) {
  const unsigned reference = fmu_.description().reference(variable);
  double value = 0.0;
  if (SONOGLIDE_CALL3(*this, fmi3GetFloat64)(instance_, &reference, 1, &value, 1) != fmi3OK) {
    throw std::runtime_error(messages());
  }
  return value;
}

float Instance3::single(const std::string& variable) {
  const unsigned reference = fmu_.description().reference(variable);
  float value = 0.0F;
  if (SONOGLIDE_CALL3(*this, fmi3GetFloat32)(instance_, &reference, 1, &value, 1) != fmi3OK) {
    throw std::runtime_error(messages());
  }
  return value;
}

std::int32_t Instance3::integer(const std::string& variable) {
  const unsigned reference = fmu_.description().reference(variable);
  std::int32_t value = 0;
  if (SONOGLIDE_CALL3(*this, fmi3GetInt32)(instance_, &reference, 1, &value, 1) != fmi3OK) {
    throw std::runtime_error(messages());
  }
  return value;
}

std::string Instance3::text(const std::string& variable) {
  const unsigned reference = fmu_.description().reference(variable);
  const char* value = nullptr;
  if (SONOGLIDE_CALL3(*this, fmi3GetString)(instance_, &reference, 1, &value, 1) != fmi3OK) {
    throw std::runtime_error(messages());
  }
  return value;
}

Stepped Instance3::step(double point_s, double size_s) {
  bool event_needed = true;
  bool terminate = true;
  Stepped stepped{};
  stepped.status = SONOGLIDE_CALL3(*this, fmi3DoStep)(
      instance_, point_s, size_s, true, &event_needed, &terminate, &stepped.early, &stepped.time_s);
  if (event_needed || terminate) {
    throw std::runtime_error("the FMU asks for an event or for the end");
  }
  return stepped;
}

std::vector<std::uint8_t> Instance3::serialized_state() {
  fmi3FMUState state = nullptr;
  std::size_t size = 0;
  std::vector<std::uint8_t> bytes;
  bool good = SONOGLIDE_CALL3(*this, fmi3GetFMUState)(instance_, &state) == fmi3OK &&
              SONOGLIDE_CALL3(*this, fmi3SerializedFMUStateSize)(instance_, state, &size) == fmi3OK;
  bytes.resize(size);
  good = good && SONOGLIDE_CALL3(*this, fmi3SerializeFMUState)(instance_, state, bytes.data(),
                                                               size) == fmi3OK;
  good = SONOGLIDE_CALL3(*this, fmi3FreeFMUState)(instance_, &state) == fmi3OK && good;
  if (!good || state != nullptr) {
    throw std::runtime_error(messages());
  }
  return bytes;
}

void Instance3::restore(const std::vector<std::uint8_t>& bytes) {
  fmi3FMUState state = nullptr;
  bool good = SONOGLIDE_CALL3(*this, fmi3DeserializeFMUState)(instance_, bytes.data(), bytes.size(),
                                                              &state) == fmi3OK &&
              SONOGLIDE_CALL3(*this, fmi3SetFMUState)(instance_, state) == fmi3OK;
  good = SONOGLIDE_CALL3(*this, fmi3FreeFMUState)(instance_, &state) == fmi3OK && good;
  if (!good) {
    throw std::runtime_error(messages());
  }
}

}  // namespace sonoglide::acceptance
