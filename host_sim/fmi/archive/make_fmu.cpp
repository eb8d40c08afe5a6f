#include "host_sim/fmi/archive/make_fmu.hpp"

#include <fmt/format.h>

#include <vector>

#include "host_sim/fmi/archive/file_content.hpp"
#include "host_sim/fmi/archive/sources.hpp"
#include "host_sim/fmi/archive/zip_writer.hpp"
#include "host_sim/fmi/resources.hpp"
#include "host_sim/output/written_files.hpp"
#include "host_sim/process/scratch_folder.hpp"
#include "host_sim/scene_file/reader.hpp"

namespace sonoglide::fmi {
namespace {

namespace fs = std::filesystem;

/// As the versions of the interface name this machine.
std::string platform(Version version) {
  return version == Version::fmi3 ? SONOGLIDE_PROCESSOR "-linux" : "linux64";
}

/// A C name, for the functions of an FMU in source form begin with it.
std::string identifier_of(stepped::Kind kind) {
  return fmt::format("sonoglide_{}", scene::name_of(stepped::kinds, kind));
}

void add_sources(ZipWriter& archive, const fs::path& tree, const std::string& identifier) {
  const std::vector<SourceText> sources = engine_sources(tree);
  for (const SourceText& source : sources) {
    archive.add("sources/" + source.name, source.text);
  }
  archive.add("sources/buildDescription.xml", build_description(sources, identifier));
}

void pack(const fs::path& path, const scene::Scene& given, Content content, Version version,
          const Parts& parts, const std::string& tool) {
  const std::string engine = file_content(parts.engine);
  const Resources resources = make_resources(given, content, engine);
  const scene::Scene scene = scene_file::read_text(resources.scene, Resources::scene_name);
  const std::string identifier = identifier_of(content.kind);
  ZipWriter archive(path);
  archive.add(
      "modelDescription.xml",
      model_description(scene, content, version, {given.name, identifier, resources.token, tool}));
  archive.add(fmt::format("binaries/{}/{}.so", platform(version), identifier), engine);
  archive.add(std::string("resources/") + Resources::scene_name, resources.scene);
  archive.add(std::string("resources/") + Resources::kind_name, words_of(content));
  archive.add(std::string("resources/") + Resources::token_name, resources.token);
  add_sources(archive, parts.sources, identifier);
  archive.close();
}

}  // namespace

Parts find_parts() {
  const fs::path prefix = fs::read_symlink("/proc/self/exe").parent_path().parent_path();
  Parts parts{prefix / "lib/sonoglide/fmu.so", prefix / "share/sonoglide/source"};
  if (!fs::exists(parts.engine)) {
    output::fail(parts.engine, "is missing; every FMU holds it, and it is built with the program");
  }
  if (!fs::exists(parts.sources / "host_sim/fmi")) {
    parts.sources = SONOGLIDE_SOURCE;
  }
  if (!fs::exists(parts.sources / "host_sim/fmi")) {
    output::fail(parts.sources, "has no sources of an FMU");
  }
  return parts;
}

std::string make_fmu(const scene::Scene& scene, Content content, Version version,
                     const Parts& parts, const std::string& tool) {
  const process::ScratchFolder scratch(fs::temp_directory_path());
  const fs::path whole = scratch.path() / "whole.fmu";
  pack(whole, scene, content, version, parts, tool);
  return file_content(whole);
}

}  // namespace sonoglide::fmi
