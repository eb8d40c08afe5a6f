/// An instance as an importer holds it: what it throws becomes a message and a status.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host_sim/fmi/binary/floating_point.hpp"
#include "host_sim/fmi/instance.hpp"
#include "host_sim/fmi/resources.hpp"

namespace sonoglide::fmi {

/// As both versions of the interface number them.
enum class Status { ok = 0, warning = 1, discard = 2, error = 3 };

/// Takes the messages of an instance; empty where nobody wants them.
using Log = std::function<void(Status status, const char* category, const std::string& message)>;

class Component {
 public:
  /// @return null, after a message, where there can be no instance
  static std::unique_ptr<Component> create(const std::filesystem::path& resources,
                                           std::string_view token, const Log& log) noexcept {
    const OwnFloatingPoint own;
    try {
      return std::make_unique<Component>(read_resources(resources), token, log);
    } catch (const std::exception& error) {
      tell(log, Status::error, error);
      return nullptr;
    }
  }

  /// For create().
  Component(Resources resources, std::string_view token, Log log)
      : log_(std::move(log)), instance_(std::move(resources), token) {}

  /// Nothing that a call throws leaves the library.
  template <class Call>
  Status attempt(const Call& call) noexcept {
    const OwnFloatingPoint own;
    try {
      call(instance_);
      return Status::ok;
    } catch (const StepError& error) {
      return tell(log_, Status::discard, error);
    } catch (const std::exception& error) {
      return tell(log_, Status::error, error);
    }
  }

  bool has_clock() const { return instance_.has_clock(); }

  bool may_stop_early = false;

 private:
  static Status tell(const Log& log, Status status, const std::exception& error) noexcept {
    try {
      if (log) {
        log(status, status == Status::discard ? "logStatusDiscard" : "logStatusError",
            error.what());
      }
    } catch (const std::exception&) {
      return Status::error;  // Nobody can be told.
    }
    return status;
  }

  Log log_;
  Instance instance_;
};

// States as importers hold them.

inline State& state_at(void* state) {
  if (state == nullptr) {
    throw CallError("there is no state to be read");
  }
  return *static_cast<State*>(state);
}

/// @param state  null, or one that is written over
inline void save_into(Instance& instance, void*& state) {
  if (state == nullptr) {
    state = new State(instance.save());
  } else {
    *static_cast<State*>(state) = instance.save();
  }
}

inline void free_state(void** state) {
  if (state != nullptr) {
    delete static_cast<State*>(*state);
    *state = nullptr;
  }
}

inline void serialize(const Instance& instance, const State& state, void* bytes, std::size_t size) {
  const std::vector<std::uint8_t> serialized = instance.bytes_of(state);
  if (size < serialized.size()) {
    throw CallError("there is no room for the serialized state");
  }
  std::memcpy(bytes, serialized.data(), serialized.size());
}

}  // namespace sonoglide::fmi
