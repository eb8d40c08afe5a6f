/// One of the scenes that a document with varied keys stands for.
#pragma once

#include <toml++/toml.h>

#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "host_sim/scene_file/document.hpp"

namespace sonoglide::scene_file {

/// Whether a number is written without a point or an exponent, so that TOML takes it for an
/// integer: a whole one of a magnitude below 1e16, as fmt has it.
inline bool is_written_whole(double number) {
  constexpr double largest_plain = 1e16;
  return std::trunc(number) == number && std::abs(number) < largest_plain;
}

/// A number, a word or a truth value, as the option `--set KEY=VALUE` gives it.
class VariedValue {
 public:
  /// An integer where it is written whole, a real number otherwise.
  explicit VariedValue(double number) : value_(toml::value<double>(number)) {
    if (is_written_whole(number)) {
      value_ = toml::value<std::int64_t>(static_cast<std::int64_t>(number));
    }
  }
  explicit VariedValue(std::string word) : value_(toml::value<std::string>(std::move(word))) {}
  explicit VariedValue(bool truth) : value_(toml::value<bool>(truth)) {}
  VariedValue(const char* word) = delete;  // would be a truth value

  const toml::node& node() const {
    return std::visit([](const toml::node& value) -> const toml::node& { return value; }, value_);
  }

 private:
  std::variant<toml::value<std::int64_t>, toml::value<double>, toml::value<std::string>,
               toml::value<bool>>
      value_;
};

/// Keys of a scene, `table.key` each, that it has no use for.
using UnusedKeys = std::set<std::string>;

/// Whose values a scene is read with.
enum class Values {
  stated,  ///< those of the tables that the controller believes
  truth,   ///< with the true values in their place
};

/// A document with a value for each of its varied keys; cheap against the document. What it is made
/// of outlives it.
class Variant {
 public:
  /// @param values  of the varied keys, in their order
  /// @param unused  takes the keys that the scene cannot use; null: each of them is an error
  Variant(const Document& document, const std::vector<VariedValue>& values,
          UnusedKeys* unused = nullptr, Values whose = Values::stated)
      : document_(document), values_(values), unused_(unused), whose_(whose) {}

  const SceneTable* find(std::string_view name) const {
    return whose_ == Values::truth ? document_.find_true(name) : document_.find(name);
  }
  const Document& document() const { return document_; }

  const toml::node& value(const GivenValue& entry) const {
    return entry.value != nullptr ? *entry.value : values_[entry.varied].node();
  }

  UnusedKeys* unused() const { return unused_; }

 private:
  const Document& document_;
  const std::vector<VariedValue>& values_;
  UnusedKeys* unused_;
  Values whose_;
};

}  // namespace sonoglide::scene_file
