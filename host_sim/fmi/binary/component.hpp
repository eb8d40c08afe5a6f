/// An instance as an importer holds it: what it throws becomes a message and a status.
#pragma once

#include <cfenv>
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

#include "host_sim/fmi/instance.hpp"
#include "host_sim/fmi/resources.hpp"

namespace sonoglide::fmi {

/// As both versions of the interface number them.
enum class Status { ok = 0, error = 3 };

/// Takes the messages of an instance; empty where nobody wants them.
using Log = std::function<void(Status status, const char* category, const std::string& message)>;

/// While it lives, floating point is as at the start of a program: an importer may have set
/// flush-to-zero, with which the bits of a simulation change. Afterwards it is as the importer had
/// it, with the importer's own flags.
class OwnFloatingPoint {
 public:
  OwnFloatingPoint() {
    std::fegetenv(&kept_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~OwnFloatingPoint() { std::fesetenv(&kept_); }
  OwnFloatingPoint(const OwnFloatingPoint&) = delete;
  OwnFloatingPoint& operator=(const OwnFloatingPoint&) = delete;

 private:
  std::fenv_t kept_{};
};

class Component {
 public:
  /// @param resources  in UTF-8, as importers name folders on every system
  /// @return null, after a message, where there can be no instance
  static std::unique_ptr<Component> create(const std::string& resources, std::string_view token,
                                           const Log& log) noexcept {
    const OwnFloatingPoint own;
    try {
      return std::make_unique<Component>(read_resources(std::filesystem::u8path(resources)), token,
                                         log);
    } catch (const std::exception& error) {
      tell(log, error);
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
    } catch (const std::exception& error) {
      return tell(log_, error);
    }
  }

  bool may_stop_early = false;

 private:
  static Status tell(const Log& log, const std::exception& error) noexcept {
    try {
      if (log) {
        log(Status::error, "logStatusError", error.what());
      }
    } catch (const std::exception&) {
      return Status::error;  // Nobody can be told.
    }
    return Status::error;
  }

  Log log_;
  Instance instance_;
};

/// @param stop_s  counts where it is defined
inline TimeRange range_of(double start_s, bool stop_defined, double stop_s) {
  return stop_defined ? TimeRange{start_s, stop_s} : TimeRange{start_s};
}

/// For what the description of the model says that there is none.
[[noreturn]] inline void refuse(const char* what) {
  throw CallError(std::string(what) + ": this FMU has none");
}

/// The same where there is no instance.
inline void tell_refusal(const Log& log, const char* what) noexcept {
  try {
    if (log) {
      log(Status::error, "logStatusError", std::string(what) + ": this FMU has none");
    }
  } catch (const std::exception&) {
    return;  // Nobody can be told.
  }
}

// What importers hand over.

template <class... Targets>
void require_pointers(const Targets*... pointers) {
  const bool any_is_null = (... || (pointers == nullptr));
  if (any_is_null) {
    throw CallError("a pointer is null; allowed: the address of what is read or written");
  }
}

/// @param n  elements in each
template <class... Elements>
void require_arrays(std::size_t n, const Elements*... arrays) {
  if (n > 0) {
    require_pointers(arrays...);
  }
}

template <Type Wanted>
bool is_of(Type type) {
  return type == Wanted;
}

/// Takes or gives a value of each variable.
/// @param type   of all of them, as the interface calls it
/// @param is_it  whether a type of variables is that one
/// @param call   with a reference and its element of the values
template <class Element, class Call>
void for_each_value(Instance& instance, const std::uint32_t* references, std::size_t n,
                    Element* values, const char* type, bool (*is_it)(Type), const Call& call) {
  require_arrays(n, references, values);
  for (std::size_t i = 0; i < n; ++i) {
    const Variable& variable = instance.variable(references[i]);
    if (!is_it(variable.type())) {
      throw CallError(variable.name + " is no " + type);
    }
    call(references[i], values[i]);
  }
}

inline void require_categories(std::size_t count, const char* const* categories) {
  require_arrays(count, categories);
  for (std::size_t i = 0; i < count; ++i) {
    require_pointers(categories[i]);
    if (std::string_view(categories[i]).substr(0, 9) != "logStatus") {
      throw CallError(std::string(categories[i]) + " is no log category; allowed: logStatusError");
    }
  }
}

// States as importers hold them.

inline State& state_at(void* state) {
  if (state == nullptr) {
    throw CallError("there is no state to be read");
  }
  return *static_cast<State*>(state);
}

/// @param state  points to null, or to a state that is written over
inline void save_into(Instance& instance, void** state) {
  require_pointers(state);
  if (*state == nullptr) {
    *state = new State(instance.save());
  } else {
    *static_cast<State*>(*state) = instance.save();
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
  require_pointers(static_cast<const std::uint8_t*>(bytes));
  std::memcpy(bytes, serialized.data(), serialized.size());
}

inline void deserialize(const Instance& instance, const std::uint8_t* bytes, std::size_t size,
                        void** state) {
  require_pointers(state);
  require_arrays(size, bytes);
  *state = new State(instance.state_of(bytes, size));
}

}  // namespace sonoglide::fmi
