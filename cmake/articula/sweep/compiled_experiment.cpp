// SPDX-License-Identifier: Apache-2.0
/// @file sweep --compile: the robot and the controller in a library that is loaded.
#include "project/cached_build.hpp"
#include "sweep/any_experiment_text.hpp"
#include "sweep_plan.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <span>
#include <string>

namespace terminal {

namespace {

/// The source of the library. Its controllers are those of a pack, so runs go into lanes.
std::string source_of(ControllerKind kind) {
  const KindTraits& traits = traits_of(kind);
  const std::string controller = "articula::" + std::string(traits.class_name) + "<SweptRobot, S>";
  return "// The experiment of `articula sweep --compile`.\n"
         "#include \"any_experiment.hpp\"\n\n"
         "#include <articula/control/computed_torque.hpp>\n"
         "#include <articula/control/pid.hpp>\n"
         "#include <articula/control/pid_plus_gravity.hpp>\n"
         "#include <swept_robot.hpp>\n\n"
         "extern \"C\" terminal::AnyExperiment* make_experiment(const terminal::SweptLoop& loop) "
         "{\n"
         "  constexpr int n = articula::joint_count<SweptRobot>;\n"
         "  const auto make = []<class S>(const articula::JointPidGains<n, S>& gains) {\n"
         "    return " +
         controller +
         "(gains);\n"
         "  };\n"
         "  return new terminal::AnyExperiment(\n"
         "      terminal::any_experiment(SweptRobot(), make, loop));\n"
         "}\n\n"
         "extern \"C\" const std::size_t* interface_sizes() {\n"
         "  return terminal::interface_sizes.data();\n"
         "}\n";
}

/// The name and the features of this processor: a library for another one is another library.
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  std::string text, line;
  while (std::getline(file, line) && !line.empty()) {
    for (const char* key : {"model name", "flags", "Features", "CPU part"}) {
      if (line.starts_with(key)) text += line + '\n';
    }
  }
  return text;
}

}  // namespace

MakeExperiment* compiled_experiment(const SweepPlan& plan) {
  const Project project{
      .name = "swept",
      .files = {
          {"robot.urdf", plan.urdf},
          {"any_experiment.hpp", any_experiment_text},
          {"swept.cpp", source_of(plan.controllers.controllers.front().kind)},
          {"processor.txt", processor()},
          {"CMakeLists.txt", project_lines("swept", "urdf config sweep", "SweptRobot",
                                           plan.controllers, plan.allows_unphysical, false) +
                                 "include(CheckCXXCompilerFlag)\n"
                                 "check_cxx_compiler_flag(-march=native HAS_MARCH_NATIVE)\n"
                                 "add_library(swept MODULE swept.cpp)\n"
                                 "target_compile_options(swept PRIVATE "
                                 "$<$<BOOL:${HAS_MARCH_NATIVE}>:-march=native>)\n"
                                 "target_link_libraries(swept PRIVATE SweptRobot articula::config "
                                 "articula::sweep)\n"}}};
  const auto library = cached_build(project, "libswept.so", "urdf, config and sweep");
  void* loaded = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);  // until the program ends
  void* make = loaded == nullptr ? nullptr : dlsym(loaded, "make_experiment");
  void* sizes = make == nullptr ? nullptr : dlsym(loaded, "interface_sizes");
  if (sizes == nullptr) throw Refusal(library.string() + ": " + dlerror());
  const std::size_t* own = reinterpret_cast<const std::size_t* (*)()>(sizes)();
  if (!std::ranges::equal(std::span(own, interface_sizes.size()), interface_sizes)) {
    throw Refusal(library.string() +
                  " is of another articula than this program: the installed "
                  "package and the program must be of the same sources");
  }
  return reinterpret_cast<MakeExperiment*>(make);
}

}  // namespace terminal
