/// One of the scenes that a document with varied keys stands for.
#pragma once

#include <string_view>
#include <vector>

#include "host_sim/scene/document.hpp"
#include "host_sim/scene/number.hpp"

namespace sonoglide::scene {

/// A document with a number for each of its varied keys; cheap against the document. The document
/// outlives it.
class Variant {
 public:
  /// @param numbers  of the varied keys, in their order
  Variant(const Document& document, const std::vector<double>& numbers)
      : document_(document), numbers_(numbers.begin(), numbers.end()) {}

  const Table* find(std::string_view name) const { return document_.find(name); }
  const Document& document() const { return document_; }

  const toml::node& value(const Entry& entry) const {
    return entry.value != nullptr ? *entry.value : numbers_[entry.varied].node();
  }

 private:
  const Document& document_;
  std::vector<Number> numbers_;
};

}  // namespace sonoglide::scene
