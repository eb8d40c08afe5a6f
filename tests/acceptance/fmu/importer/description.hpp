/// modelDescription.xml, as an importer reads it.
#pragma once

#include <boost/property_tree/ptree.hpp>

#include <map>
#include <string>

#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance {

using Tree = boost::property_tree::ptree;

/// An unpacked FMU in a folder.
class Description {
 public:
  /// @param fmu  unpacked in a folder of this name in `folder`
  Description(const ScratchFolder& folder, const std::string& fmu);
  Description(const Description&) = delete;
  Description& operator=(const Description&) = delete;

  /// fmiModelDescription.
  const Tree& root() const { return root_; }
  /// The attributes of CoSimulation.
  std::string stepping(const std::string& attribute) const;
  /// Of the root.
  std::string attribute(const std::string& name) const;
  /// @throws std::out_of_range  there is no such variable
  unsigned reference(const std::string& variable) const;
  std::string start(const std::string& variable) const;
  /// The element of a variable, whatever its type.
  const Tree& variable(const std::string& name) const;
  double step_s() const;

 private:
  Tree root_;
  std::map<std::string, const Tree*> variables_;
};

/// An attribute of an element; empty where it has none.
std::string attribute_of(const Tree& element, const std::string& name);

/// Writes an FMU of a scene that is in the folder, and unpacks it.
/// @param options  besides the scene and --out
void make_fmu(const ScratchFolder& folder, const std::string& scene, const std::string& options,
              const std::string& fmu);

}  // namespace sonoglide::acceptance
