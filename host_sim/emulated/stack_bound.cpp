#include <algorithm>
#include <map>
#include <set>

#include "host_sim/emulated/disassembly.hpp"
#include "host_sim/emulated/image.hpp"

namespace sonoglide::emulated {
namespace {

/// Walks the calls, each function once.
class DeepestPath {
 public:
  explicit DeepestPath(const Functions& functions) : functions_(functions) {}

  StackBound from(const std::string& name) {
    const auto known = bounds_.find(name);
    if (known != bounds_.end()) {
      return known->second;
    }
    if (!open_.insert(name).second) {
      return {0, name + " calls itself"};
    }
    StackBound bound = below(name);
    open_.erase(name);
    bounds_[name] = bound;
    return bound;
  }

 private:
  StackBound below(const std::string& name) {
    const auto found = functions_.find(name);
    if (found == functions_.end()) {
      return {0, name + " is not in the image"};
    }
    const Function& function = found->second;
    StackBound bound{function.frame_bytes, function.doubt};
    for (const std::string& called : function.calls) {
      const StackBound deeper = from(called);
      bound.bytes = std::max(bound.bytes, function.frame_bytes + deeper.bytes);
      if (bound.unbounded_by.empty()) {
        bound.unbounded_by = deeper.unbounded_by;
      }
    }
    return bound;
  }

  const Functions& functions_;
  std::map<std::string, StackBound> bounds_;
  std::set<std::string> open_;
};

}  // namespace

StackBound stack_bound(const std::string& disassembly, const std::string& entry) {
  const Functions functions = functions_in(disassembly);
  return DeepestPath(functions).from(entry);
}

}  // namespace sonoglide::emulated
