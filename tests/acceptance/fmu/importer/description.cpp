#include "tests/acceptance/fmu/importer/description.hpp"

#include <boost/property_tree/xml_parser.hpp>

#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace sonoglide::acceptance {

std::string attribute_of(const Tree& element, const std::string& name) {
  return element.get(Tree::path_type("<xmlattr>/" + name, '/'), std::string());
}

Description::Description(const ScratchFolder& folder, const std::string& fmu) {
  std::istringstream text(folder.read(fmu + "/modelDescription.xml"));
  Tree document;
  boost::property_tree::read_xml(text, document);
  root_ = document.get_child("fmiModelDescription");
  for (const auto& [type, element] : root_.get_child("ModelVariables")) {
    variables_.emplace(attribute_of(element, "name"), &element);
  }
}

std::string Description::stepping(const std::string& attribute) const {
  return attribute_of(root_.get_child("CoSimulation"), attribute);
}

std::string Description::attribute(const std::string& name) const {
  return attribute_of(root_, name);
}

const Tree& Description::variable(const std::string& name) const {
  return *variables_.at(name);
}

unsigned Description::reference(const std::string& name) const {
  return static_cast<unsigned>(std::stoul(attribute_of(variable(name), "valueReference")));
}

std::string Description::start(const std::string& name) const {
  return attribute_of(variable(name), "start");
}

double Description::step_s() const {
  return std::strtod(attribute_of(root_.get_child("DefaultExperiment"), "stepSize").c_str(),
                     nullptr);
}

void make_fmu(const ScratchFolder& folder, const std::string& scene, const std::string& options,
              const std::string& fmu) {
  const std::string file = fmu + ".fmu";
  const Outcome made = folder.run("fmu " + scene + " " + options + " --quiet --out " + file);
  const Outcome unpacked = folder.run_program(
      "cmake", "-E make_directory " + fmu + " && cd " + fmu + " && cmake -E tar xf ../" + file);
  if (made.exit_code != 0 || unpacked.exit_code != 0) {
    throw std::runtime_error(made.err + unpacked.err);
  }
}

}  // namespace sonoglide::acceptance
