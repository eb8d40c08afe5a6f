/// A value that comes with a reading of a document, not with the document.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <string>
#include <variant>

namespace sonoglide::scene_file {

/// Whether a number is written without a point or an exponent, so that TOML takes it for an
/// integer: a whole one of a magnitude below 1e16, as fmt has it.
bool is_written_whole(double number);

/// A number, a word or a truth value, as the option `--set KEY=VALUE` gives it.
class VariedValue {
 public:
  /// An integer where it is written whole, a real number otherwise.
  explicit VariedValue(double number);
  explicit VariedValue(std::string word);
  explicit VariedValue(bool truth);
  VariedValue(const char* word) = delete;  // would be a truth value

  const toml::node& node() const {
    return std::visit([](const toml::node& value) -> const toml::node& { return value; }, value_);
  }

 private:
  std::variant<toml::value<std::int64_t>, toml::value<double>, toml::value<std::string>,
               toml::value<bool>>
      value_;
};

}  // namespace sonoglide::scene_file
