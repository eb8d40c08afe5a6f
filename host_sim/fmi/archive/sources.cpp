#include "host_sim/fmi/archive/sources.hpp"

#include <fmt/format.h>
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>
#include <utility>

#include "host_sim/fmi/archive/file_content.hpp"
#include "host_sim/output/written_files.hpp"

namespace sonoglide::fmi {
namespace {

namespace fs = std::filesystem;

/// Folders with all that is inside them.
constexpr std::array whole_folders = {
    "firmware/numeric",    "firmware/friction",  "firmware/plant",
    "firmware/control",    "firmware/app",       "firmware/link",
    "firmware/store",      "firmware/encoding",  "hal/host",
    "host_sim/scene",      "host_sim/configure", "host_sim/loop",
    "host_sim/scene_file", "host_sim/process",   "host_sim/stepped",
    "host_sim/fmi/binary"};
/// Folders without the folders inside them.
constexpr std::array plain_folders = {"hal", "host_sim/fmi"};

/// The arithmetics of the controllers, as host_sim/CMakeLists.txt lists them.
constexpr std::array<std::pair<const char*, const char*>, 4> arithmetics = {
    {{"float32", "float"},
     {"float64", "double"},
     {"q31", "numeric::Q31<numeric::Counting>"},
     {"q15", "numeric::Q15<numeric::Counting>"}}};

bool is_source(const fs::path& path) {
  return path.extension() == ".hpp" || path.extension() == ".cpp";
}

bool is_unit(const SourceText& source) {
  return fs::path(source.name).extension() == ".cpp";
}

template <class Walk>
void add_folder(std::vector<SourceText>& sources, const fs::path& tree, const char* folder) {
  std::error_code error;
  for (const fs::directory_entry& entry : Walk(tree / folder, error)) {
    if (entry.is_regular_file() && is_source(entry.path())) {
      sources.push_back(
          {entry.path().lexically_relative(tree).generic_string(), file_content(entry.path())});
    }
  }
  if (error) {
    output::fail(tree / folder, error);
  }
}

std::string filled(std::string text, const std::string& place, const std::string& word) {
  for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at)) {
    text.replace(at, place.size(), word);
  }
  return text;
}

/// As host_sim/CMakeLists.txt does it.
void add_made(std::vector<SourceText>& sources, const fs::path& tree) {
  const std::string laws = file_content(tree / "host_sim/loop/law_plants.cpp.in");
  const std::string controls = file_content(tree / "host_sim/loop/arithmetic_control.cpp.in");
  std::error_code error;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(tree / "host_sim/scene/laws", error)) {
    const std::string law = entry.path().stem().string();
    sources.push_back(
        {fmt::format("host_sim/loop/{}_plants.cpp", law), filled(laws, "@law@", law)});
  }
  if (error) {
    output::fail(tree / "host_sim/scene/laws", error);
  }
  for (const auto& [name, scalar] : arithmetics) {
    sources.push_back(
        {fmt::format("host_sim/loop/{}_control.cpp", name), filled(controls, "@scalar@", scalar)});
  }
}

}  // namespace

std::vector<SourceText> engine_sources(const fs::path& tree) {
  std::vector<SourceText> sources;
  for (const char* folder : whole_folders) {
    add_folder<fs::recursive_directory_iterator>(sources, tree, folder);
  }
  for (const char* folder : plain_folders) {
    add_folder<fs::directory_iterator>(sources, tree, folder);
  }
  add_made(sources, tree);
  std::sort(sources.begin(), sources.end(),
            [](const SourceText& a, const SourceText& b) { return a.name < b.name; });
  return sources;
}

std::string build_description(const std::vector<SourceText>& sources,
                              const std::string& identifier) {
  using Node = boost::property_tree::ptree;
  const auto named = [](const std::string& name) {
    Node element;
    element.put("<xmlattr>.name", name);
    return element;
  };
  Node set;
  set.put("<xmlattr>.language", "C++17");
  set.put("<xmlattr>.compiler", "gcc");
  set.put("<xmlattr>.compilerOptions", "-O3 -ffp-contract=off -fPIC -fvisibility=hidden");
  for (const SourceText& source : sources) {
    if (is_unit(source)) {
      set.add_child("SourceFile", named(source.name));
    }
  }
  Node header_only = named("TOML_HEADER_ONLY");
  header_only.put("<xmlattr>.value", "0");
  set.add_child("PreprocessorDefinition", header_only);
  set.add_child("IncludeDirectory", named("."));
  set.add_child("IncludeDirectory", named("/usr/include/eigen3"));
  Node configuration;
  configuration.put("<xmlattr>.modelIdentifier", identifier);
  configuration.put("<xmlattr>.description",
                    "Headers of fmt 9, toml++ 3.3, nlohmann-json 3.11 and Eigen 3.4 are needed: in "
                    "Debian 12 libfmt-dev, libtomlplusplus-dev, nlohmann-json3-dev, libeigen3-dev");
  configuration.add_child("SourceFileSet", set);
  Node root;
  root.put("fmiBuildDescription.<xmlattr>.fmiVersion", "3.0");
  root.get_child("fmiBuildDescription").add_child("BuildConfiguration", configuration);
  std::ostringstream text;
  boost::property_tree::write_xml(
      text, root, boost::property_tree::xml_writer_make_settings<std::string>(' ', 2));
  return text.str();
}

}  // namespace sonoglide::fmi
