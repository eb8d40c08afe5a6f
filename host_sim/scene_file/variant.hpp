/// One of the scenes that a document with varied keys stands for.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/scene_file/document.hpp"
#include "host_sim/scene_file/varied_value.hpp"

namespace sonoglide::scene_file {

/// Keys of a scene, `table.key` each, that it has no use for.
using UnusedKeys = std::set<std::string>;

/// A document with a value for each of its varied keys; cheap against the document. What it is made
/// of outlives it.
class Variant {
 public:
  /// @param values  of the varied keys, in their order
  /// @param unused  takes the keys that the scene cannot use; null: each of them is an error
  Variant(const Document& document, const std::vector<VariedValue>& values,
          UnusedKeys* unused = nullptr)
      : document_(document), values_(values), unused_(unused) {}

  const Table* find(std::string_view name) const { return document_.find(name); }
  const Document& document() const { return document_; }

  const toml::node& value(const Entry& entry) const {
    return entry.value != nullptr ? *entry.value : values_[entry.varied].node();
  }

  UnusedKeys* unused() const { return unused_; }

 private:
  const Document& document_;
  const std::vector<VariedValue>& values_;
  UnusedKeys* unused_;
};

}  // namespace sonoglide::scene_file
